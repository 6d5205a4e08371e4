// SPDX-License-Identifier: GPL-3.0-or-later
/// The printed multiscale space (Leok 2004, sec. 7.2): in each coordinate a slow polynomial times one
/// oscillation,
///     q(t) = P(t) F(t),   P = sum_{j <= n} p_j P_j(2t/h - 1),   F = 1 + alpha sin wt + beta cos wt,
/// with alpha and beta, and if asked for w, unknown in every step. It is kept to be looked at: it fails, and
/// shows why the amplitudes of basis.hpp are added.
///
///   - The fast amplitude is that of the slow part. That of the pendulum's angle is largest where the angle
///   passes 0, that of
///     its spring stays as it is while the spring's mean changes by a factor: no such curve follows either.
///   - Where the amplitude or P vanishes, alpha, beta or w mean nothing: the Hessian of the action is
///   singular there.
///   - Constants are not variations of such a curve, and neither is dP F. So Noether's theorem does not hold
///   for the discrete action.
///
/// The curve depends on its unknowns X = (p, alpha, beta, w) nonlinearly. With the multiplier p_1 of each
/// coordinate,
///     R_j = sum_i w_i [ L_q dq/dX_j + L_v dv/dX_j ] - p_1 dq(h)/dX_j + p_0 dq(0)/dX_j = 0,    q(0) = q_0,
/// as many equations as unknowns; Newton's method with second derivatives of q. The first guess is the best
/// one can think of: the additive curve, solved for the same step, with its amplitudes divided by the mean of
/// P.
#pragma once

#include <memory>
#include <span>

#include "engine/family/scheme.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

bool isProduct(const Settings& space);
Properties describeProduct(const Settings& space, const Settings& quadrature);
Settings completeProductRule(const Settings& space, const Settings& quadrature);

/// Throws InvalidScene (pointer relative to the scheme) where a rule does not resolve the oscillation.
std::unique_ptr<Integrator> makeProductIntegrator(const System& system, const Discretization& discretization,
                                                  const Clock& clock, const SolverPolicy& policy);

/// (X, p_1) of the last step, coordinate by coordinate, of an integrator made here: for those who look at its
/// equations.
std::span<const double> productUnknowns(const Integrator& product);

}  // namespace extremal
