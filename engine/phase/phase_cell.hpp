// SPDX-License-Identifier: GPL-3.0-or-later
/// Space x quadrature for a Hamiltonian: q in the space, continuous; p in the space of its slopes,
/// discontinuous, joined by the multiplier p_k at the nodes of time.
///
/// Functions phi_a of a table (action/table.hpp), a = 0..m-1, psi_a = phi_a', rule (c_i, b_i), i = 0..n-1:
///     q(c_i) = q_0 + sum_a phi_a alpha_a,    h q'(c_i) = sum_a psi_a alpha_a,    p(c_i) = sum_a psi_a
///     beta_a, S = h sum_i b_i [ p_i . q'_i - H(t_i, q_i, p_i) ] - p_1 . (q(1) - q_1) + p_0 . (q(0) - q_0).
/// Stationary in beta, alpha and q(0), with G_ab = sum_i b_i psi_a psi_b and phi_a(1) = 1 for the last a,
/// else 0 (e is that column):
///     G alpha = h sum_i b_i psi_i H_p,i,            q_1 = q_0 + alpha_{m-1},
///     G beta  = e p_1 + h sum_i b_i phi_i H_q,i,    p_1 = p_0 - h sum_i b_i H_q,i.
/// Only G is inverted, which is regular where the rule tells the slopes apart, whatever H_pp is: H may be
/// linear in p. With K_j = H_p and F_j = -H_q at the nodes this is a pair of Runge-Kutta methods,
///     q_i = q_0 + h sum_j A_ij K_j,   p_i = r_i p_0 + h sum_j B_ij F_j,   b_i B_ij + b_j A_ji = b_i b_j,
/// where r_i = 1 if the rule integrates the slopes. Polynomials of degree s: Gauss(s) is Gauss collocation,
/// Lobatto(s+1) Lobatto IIIA-IIIB, for non-separable H too. dS = p_1 dq_1 - p_0 dq_0, so that every rule
/// makes a symplectic step.
///
/// Arrays: node i, function a at (i, a); `ofRates(a, i)` and `ofForces(a, i)` turn K and F at the nodes into
/// alpha = h ofRates K and beta = e_1 p_0 + h ofForces F, `ofMomentum(a)` being e_1 = G^{-1} e.
#pragma once

#include <Eigen/Core>

#include <memory>

#include "engine/action/table.hpp"

namespace extremal {

struct PhaseCell {
    using Matrix = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    /// Of a table that does not change with the step.
    explicit PhaseCell(const Table<double>& table);

    int nodes() const { return static_cast<int>(place.size()); }
    int unknowns() const { return static_cast<int>(value.cols()); }

    Table<double> table;
    Vector place, weight;  ///< c_i, b_i
    Matrix value, slope;   ///< phi_a, psi_a
    Matrix ofRates;        ///< G^{-1} psi^T b
    Matrix ofForces;       ///< G^{-1} (e 1^T - phi^T) b
    Vector ofMomentum;     ///< G^{-1} e
    Matrix A, B;           ///< the pair of tableaus
    Vector fromStart;      ///< r_i
    Vector endRates;       ///< q_1 = q_0 + h endRates . K
    Matrix ahead;          ///< values at the nodes of the next step of what has values here; empty: unknown
};

/// A cell of which all steps have their share: made of a table, or known before (cellOf).
class SharedCell {
public:
    SharedCell(const Table<double>& table) : cell_(std::make_shared<const PhaseCell>(table)) {}
    const PhaseCell& operator*() const { return *cell_; }
    const PhaseCell* operator->() const { return cell_.get(); }

private:
    std::shared_ptr<const PhaseCell> cell_;
};

}  // namespace extremal
