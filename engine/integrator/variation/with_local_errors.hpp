// SPDX-License-Identifier: GPL-3.0-or-later
/// An integrator that carries an estimate of its own error along, by the tangent maps M_k of its steps:
///
///     e_{k+1} = M_k e_k + d_k,   d_k = x_{k+1} - (a better step from x_k)
///
/// The better step is that of another integrator over the same time, or two halves of the step itself,
/// extrapolated: d_k = (x_{k+1} - x_halves) / (1 - 2^-p) for a scheme of order p. e is what the error is
/// while it is small; d_k says where it is made, and |M_k e_k| / |e_k| where it is amplified.
///
/// It says of each step
///     local_error         |d_k|, of the positions
///     transported_error   |e_{k+1}|, of the positions
///     local_error_sum     the sum of all |d_k|: what there would be if nothing were amplified
///     amplification       |M_k e_k| / |e_k|, of positions and momenta
/// Both e and the sum are in the memory of the state, behind that of the scheme. Only for fixed steps of
/// systems with coordinates, x = (q, p).
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"

namespace extremal {

/// Takes over the scheme and `better`. With `halves` the latter is the same scheme with half the step, of
/// order `order`. The scheme must have a tangentSize() and no memory.
std::unique_ptr<Integrator> withLocalErrors(std::unique_ptr<Integrator> scheme,
                                            std::unique_ptr<Integrator> better, bool halves, int order);

}  // namespace extremal
