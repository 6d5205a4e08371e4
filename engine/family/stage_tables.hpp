// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear part of a step for modes of their own, u'' = -K u + G(t), solved once: polynomials of degree s
/// in time with the rule (b_q, c_q), stationary in
///
///     S = h sum_q b_q [ u'^2/2 - K u^2/2 + G_q u ],     p = -dS/du(0),   p+ = dS/du(h).
/// With u = u_0 + h v tau + sum_l d_l psi_l, psi_l Lagrange's polynomials at the Lobatto points l = 1..s, and
/// e_l = sum_q b_q psi_l'(c_q) + (1 at the start) the equations of l = 0..s-1 are
///
///     sum_m [ sum_q b_q psi_l' psi_m' - h^2 K sum_q b_q psi_l psi_m ] d_m
///         = -h v e_l + h^2 K sum_q b_q psi_l (u_0 + h v c_q) - h^2 sum_q b_q psi_l G_q,
///     v+ = v + h sum_q b_q (G_q - K u_q),
/// where e_l = 0 for rules that are exact for degree s - 1; all of it is linear in u_0, v and G_q. Gauss(s)
/// makes it the Runge-Kutta-Nystrom method of that rule.
///
/// Rows of numbers, filled up with zeros to a multiple of 8. U, V: one row each; G, Y: one row per node of
/// the rule.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

class StageTables {
public:
    /// `stiffness`: K of each number in a row. Entries are not finite where a mode has no motion: a rule that
    /// does not see it.
    StageTables(int degree, const Rule<double>& rule, double h, const std::vector<double>& stiffness);
    StageTables() = default;

    std::size_t stages() const { return stages_; }
    /// Numbers in a row.
    std::size_t width() const { return width_; }
    static std::size_t widthOf(std::size_t numbers) { return inWholeLanes(numbers); }

    /// Y = a u + b v + B G.
    void toStages(const double* U, const double* V, const double* G, double* Y) const;
    /// U, V <- U+, V+.
    void toEnd(const double* G, double* U, double* V) const;
    /// G of the next step by the polynomial through that of this one.
    void extrapolate(const double* G, double* next) const;

private:
    void fill(int degree, const Rule<double>& rule, double h, const std::vector<double>& stiffness);

    std::size_t stages_ = 0, width_ = 0;
    /// In blocks of eight numbers of a row: of stage i a_i, b_i, B_i1 .. B_is; and of the end the same of u+
    /// and v+ in turn.
    std::vector<double> stage_, end_;
    std::vector<double> ahead_;  ///< (i, j): the Lagrange polynomial j of the nodes at 1 + c_i
};

}  // namespace extremal
