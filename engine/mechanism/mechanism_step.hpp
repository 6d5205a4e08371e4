// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a table with constraints, rolling conditions and forces: one system of equations.
///
/// Functions phi_a of the space (action/table.hpp, a = 0..m-1, Y_a in R^d), rule (c_i, b_i) of L and of the
/// forces, and the m + 1 Lobatto nodes (e_j, w_j), j = 0..m, for the constraints g, whatever the rule of L:
///     q = q_0 + sum_a phi_a Y_a,    v = q' / h,    Gamma_j = g_q(q(e_j))^T Lambda_j,
///     G_a = sum_i b_i [ h phi_a (L_q + F) + phi_a' L_v ] + sum_{j<m} phi_a(e_j) Gamma_j,
///     A   = h sum_i b_i (L_q + F) + sum_{j<m} Gamma_j,
///     R_a = G_a = 0 (a < m - 1),    R_{m-1} = p_0 + A - G_{m-1} = 0,    g(q(e_j)) = 0 (j = 1..m),
/// for Y_a and the impulses Lambda_j = h w_j lambda_j, j < m. Then q_1 = q_0 + Y_{m-1}, and p_1 follows from
/// the constraint on velocities at the end (Mechanism::project):
///     L_v(q_1, v_1) = p_0 + A + g_q^T kappa = p_1,    g_q v_1 + g_t = 0.
/// The last multiplier is in no R, as the test functions vanish at the end, and the first constraint holds
/// already: m multipliers for m constraints, shifted by one node.
///
/// Rolling conditions r = a v - b add a^T M_j to Gamma_j, M_j = h w_j mu_j, and hold on the velocity of the
/// curve at the m Gauss nodes; p at the end is projected on a v_1 = b as well (Jay 2009). With r at the
/// Lobatto nodes q and p would have the order m. With mu at the Gauss nodes too
/// (MechanismRules::isRollingAtGauss) the energy of a quadratic L is kept to round-off: A and the h r at the
/// nodes are those of one rule. p is then of order m for even and m + 1 for odd m, as a v_1 = b holds to that
/// order only; it is not projected, since q keeps the order 2 m with the p that is carried on, and a
/// projected one drifts.
///
/// Constraints at the nodes of L would leave g = 0 between steps, and p with an error that does not shrink:
/// g vanishes at the e_j, so that the action is right to the order of the rule of interpolation on them, and
/// order 2 m with both ends takes Lobatto nodes (Jay 1996; Wenger, Ober-Bloebaum, Leyendecker 2017). Forces
/// act in the variation (d'Alembert): with them the step is not symplectic, momenta and symmetry stay.
///
/// Steps are solved by sweeps where there are some for them and these converge (sweep/mechanism_sweeps.hpp),
/// and all others by Newton's method.
///
/// Newton's method starts from the curve of the last step, extrapolated, and its impulses. Where the
/// increments would be others than the last ones, or the root is not near, it starts from
/// q_0 + t v_0 + t^2 a_0 / 2, lambda of the state. A root that was not near this start either may be another
/// assembly of the mechanism: it is accepted if it is the one that short steps lead to
/// (solve/step_continuation.hpp). The matrix is that of the start for as long as corrections shrink well, and
/// the iteration ends where the next correction would be below the tolerance (solve/contraction.hpp); A then
/// moves with the last one, by its derivative. A tangent map has a matrix of its own, at the solution. What q
/// and p lose to rounding is carried on.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "engine/action/table.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/model/parts.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// `table` for a step; it must not change with the step. `algebra`: full matrices, or blocks of what is
/// coupled. Throws InvalidScene where the space has functions that the Lobatto nodes do not tell apart.
std::unique_ptr<Integrator> makeMechanismStep(const Parts& parts, const Table<double>& table,
                                              const MechanismRules& rules, double step,
                                              const SolverPolicy& policy,
                                              LinkedAlgebra algebra = LinkedAlgebra::automatic);

}  // namespace extremal
