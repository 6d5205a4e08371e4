// SPDX-License-Identifier: GPL-3.0-or-later
/// What becomes of L = theta(x) . x' - H(x) when all of x is taken as continuous, like the coordinates of a
/// Lagrangian: an experiment that shows why one-forms have a cell of their own (phase/one_form_step.hpp).
///
/// x of degree s on each step, Gauss's rule with s nodes and tableau (a_ij, b_i), multipliers p at the nodes
/// of time. With X_i = x_0 + h sum_j a_ij V_j and F_i = theta'(X_i)^T V_i - grad H(X_i) stationarity is
///     theta(X_i) = p_0 + h sum_j a_ij F_j,    x_1 = x_0 + h sum b_i V_i,    p_1 = p_0 + h sum b_i F_i,
/// a map of (x, p), symplectic there. Started with p = theta(x), as the equations of motion want it, it
/// leaves p = theta(x) in its first step unless theta is affine: the map has twice as many states as the
/// motion, and what it has too many oscillates for ever.
///
/// The standard projection puts p = theta(x) back after each step, along the fields of p - theta(x):
///     x = x~ + mu,    p = p~ + theta'(x)^T mu,    p = theta(x).
/// It costs the form: to second order in mu the step is not symplectic, and its energy drifts.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/first_order/one_form.hpp"

namespace extremal {

/// Says |p - theta(x)| as the quantity "one_form_constraint". Without the projection p is in the memory of
/// the state.
std::unique_ptr<Integrator> makeNaiveOneForm(const OneForm& form, int degree, bool isProjected, double step);

}  // namespace extremal
