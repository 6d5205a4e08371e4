// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a cell for a one-form P(q, y) . q' - H(q, y) with as many y as q: y has no velocity, so that
/// it is not continuous and has no multiplier, and is free at each node.
///     y_i:  P_y(q_i, y_i)^T q'_i = H_y(q_i, y_i),
///     q:    P(q_i, y_i) = p_0 + h sum_j a_ij [ P_q^T q' - H_q ]_j,    p_0 = P(q_0, y_0).
/// That is the cell of phase/phase_cell.hpp in (q, p = P(q, y)), and its y_1 solves P(q_1, y_1) = p_1. One
/// step, exactly symplectic in d(theta), of the order of the cell, with every rule. The tangent map is that
/// of the cell between D = d(q, P) / d(q, y): M = D_1^{-1} M_cell D_0.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// `cell` of a table that does not change with the step, for a form with a plane.
std::unique_ptr<Integrator> makeOneFormStep(const OneForm& form, const SharedCell& cell, double step,
                                            const SolverPolicy& policy);

}  // namespace extremal
