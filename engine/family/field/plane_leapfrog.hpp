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
#include <string>

#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

std::unique_ptr<Integrator> makePlaneLeapfrog(const System& system, double step);
/// The longest stable step, with the largest W'' between the extremes of u.
double planeLeapfrogLimit(const PlaneFieldProblem& problem, const double* u);

/// The largest eigenvalue of elements of length 1 along each axis.
struct AxisEigenvalues {
    double x = 4, y = 4;
};

/// The same of elements of a degree. `limit`: the largest stable step times frequency, infinite if every one
/// is stable.
double longestPlaneStep(const PlaneFieldProblem& problem, const double* u, int degree,
                        const AxisEigenvalues& eigenvalues, double limit);
/// Says that the step of a scheme is longer.
void checkPlaneStep(const PlaneFieldProblem& problem, double longest, const std::string& name,
                    const SchemeCase& scheme, Findings& findings);

}  // namespace extremal
