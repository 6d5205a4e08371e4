// SPDX-License-Identifier: GPL-3.0-or-later
/// Leapfrog over a periodic rectangle: bilinear functions on rectangles and lines in time, with the
/// trapezoidal rule in each direction, as a one-step method for u and u_t,
///
///     v' = v + h/2 f(u),   u+ = u + h v',   v+ = v' + h/2 f(u+),
///     f = c^2 (D_x + D_y) u - W'(u),  D second differences.
/// component by component. Explicit, of order 2, multisymplectic; stable where h^2 (4 c^2 (1/dx^2 + 1/dy^2)
/// + W'') <= 4, with the largest c and the largest eigenvalue of W''.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

std::unique_ptr<Integrator> makePlaneLeapfrog(const System& system, double step);
/// The longest stable step, with the largest W'' between the extremes of u.
double planeLeapfrogLimit(const PlaneFieldProblem& problem, const double* u);

}  // namespace extremal
