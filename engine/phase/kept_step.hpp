// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that keep invariants in place of the symplectic form: the same polynomials for x = (q, p), tested by
/// others.
///
///     x(tau) in P_s, x(0) = x_0,    x' = Pi f(x),    f = J grad H,
/// Pi the projection to P_{s-1} in the inner product of the rule (c_i, b_i). Since int grad H . x' =
/// int (Pi grad H) . J (Pi grad H) = 0, the energy is kept as well as the rule integrates; with as many nodes
/// as degrees this is Gauss collocation, which keeps none. For several invariants I_a, with G = (Pi grad
/// I_a),
///     x' = Pi [ f - G (G^T G)^{-1} G^T f ]
/// keeps all of them, as int (Pi grad I_a) . x' = 0. Order 2s, symmetric, not symplectic: M^T J M - J =
/// O(h^{2s+1}). Degree 1 with the energy is the average vector field method. Sources: Hairer 2010; Cohen and
/// Hairer 2011; Brugnano, Iavernaro and Trigiante 2010.
///
/// In Legendre's polynomials P_k of length 1, with integrals Psi_k: x_i = x_0 + h sum_k Psi_k(c_i) alpha_k,
/// and x_1 = x_0 + h alpha_0. The fixed point alpha = (projected f at the nodes) contracts with h |f'|; where
/// it is slow, Newton's method with f' alone. The tangent map is that of the energy; with a list it is not
/// known.
#pragma once

#include <memory>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/phase/invariants.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// At most so many invariants.
inline constexpr std::size_t mostInvariants = 8;

/// `flow`: Hamilton's equations. The rule has more nodes than the degree s.
std::unique_ptr<Integrator> makeKeptStep(const Mechanics<double>& flow, std::vector<Invariant> invariants,
                                         int degree, const Rule<double>& rule, double step,
                                         const SolverPolicy& policy);

}  // namespace extremal
