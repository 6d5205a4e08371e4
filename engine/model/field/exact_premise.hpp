// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether what calls itself the exact solution of a field is one: it is tested, not believed.
///
/// The equation: 0 = u_tt - (a phi'(u_x))_x + W'(u). The residual at a place is |sum of the terms| / sum of
/// |terms|, without what round-off explains.
///
/// The ends: exact solutions of the whole line know nothing of the ends of the domain. The violation g(t) is
///     dirichlet  u(end, t) - u(end, start)
///     neumann    c times the integral of u_x(end, t) over time
///     periodic   half the difference of u at both ends, and half of c times the integral of that of u_x
/// The true solution differs by a wave that enters with g at the end and runs inwards with the speed c. Of
/// the wave equation its L2 norm is at most a sum of sqrt(c integral of g^2) over stretches in which it does
/// not meet itself; of kinks and breathers it is within a factor of 3 of that (engine.run.premise).
#pragma once

#include <memory>

#include "engine/model/field/problem.hpp"
#include "engine/model/field/profile.hpp"
#include "engine/model/parts/premise_check.hpp"

namespace extremal {

/// Where a typed solution leaves the equation most; ratio 0 where it is not typed.
struct FieldResidual {
    double ratio = 0;
    double x = 0, t = 0;
    double acceleration = 0, force = 0, slope = 0;  ///< u_tt, -(a phi'(u_x))_x, W'(u)
};
FieldResidual residualOf(const FieldProfile& profile, const FieldProblem& problem, double start, double end);

struct EndViolation {
    double largest = 0;  ///< of |g|
    double place = 0;    ///< of the end
    double from = 0;     ///< when |g| first is half of that
    double size = 0;     ///< the largest |u| over the run
    double error = 0;    ///< bound of the L2 norm of the error that follows

    /// More than 1e-6 of the size.
    bool matters() const { return largest > 1e-6 * size; }
};
EndViolation endViolationOf(const ExactSolution::AtPlaces& exact, const FieldProblem& problem, double start,
                            double end);

/// Both, of a field.
PremiseCheck premiseCheckOf(const std::shared_ptr<const FieldProblem>& problem);

}  // namespace extremal
