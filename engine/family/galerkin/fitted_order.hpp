// SPDX-License-Identifier: GPL-3.0-or-later
/// The order of spaces whose functions change with the step, such as {1, tau, cos(w h tau), sin(w h tau)}.
///
/// With e_j the rate at which the H1 distance of tau^j from the space goes to 0, O(h^e_j), and d_k that of
/// D(k) (consistencyDefects), both infinite where the quantity is 0,
///     m = min_j (j + e_j),    kappa = min_k (k + d_k),    order = min( 2 (m - 1), degree of the rule + 1, 2
///     kappa ):
/// the action loses the squares of what the space and the equations inside the step leave. Rates are measured
/// between h, h/2 and h/4, at steps that become shorter until two pairs agree.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/family/table_properties.hpp"

namespace extremal::galerkin {

struct FittedOrder {
    OrderBounds bounds;
    double step = 0;           ///< at which it was measured: small
    bool isSymmetric = false;  ///< space and rule there
};
/// Throws InvalidScene where the functions or the rule are refused at small steps.
FittedOrder fittedOrder(const Settings& space, const Settings& quadrature);

}  // namespace extremal::galerkin
