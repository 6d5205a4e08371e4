// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear part of a step with Gauss(s) for modes of their own, u'' = -K u + G(t), solved once:
///
///     u_i = u + c_i h v + h^2 sum_j (A^2)_ij (G_j - K u_j)
///         = a_i u + b_i v + sum_j B_ij G_j,       (1 + h^2 K A^2) [a b B] = [1, c h, h^2 A^2],
///     u+ = u + h v + h^2 sum_j (b A)_j (G_j - K u_j),   v+ = v + h sum_j b_j (G_j - K u_j),
/// which are linear in u, v and G_j as well. Stability for every h K is that of the Gauss rule.
///
/// Rows of numbers: one for each mode, real and imaginary part side by side, filled up with zeros to a
/// multiple of 8. U, V: one row each; G, Y: one row per stage.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/quadrature/rule.hpp"

namespace extremal {

class StageTables {
public:
    /// `stiffness`: K of each mode.
    StageTables(const Rule<double>& rule, double h, const std::vector<double>& stiffness);
    StageTables() = default;

    std::size_t stages() const { return stages_; }
    /// Numbers in a row.
    std::size_t width() const { return width_; }
    static std::size_t widthOf(std::size_t modes) { return (2 * modes + 7) / 8 * 8; }

    /// Y = a u + b v + B G.
    void toStages(const double* U, const double* V, const double* G, double* Y) const;
    /// U, V <- U+, V+.
    void toEnd(const double* G, double* U, double* V) const;
    /// G of the next step by the polynomial through that of this one.
    void extrapolate(const double* G, double* next) const;

private:
    void fill(const Rule<double>& rule, double h, const std::vector<double>& stiffness);

    std::size_t stages_ = 0, width_ = 0;
    /// In blocks of eight numbers of a row: of stage i a_i, b_i, B_i1 .. B_is; and of the end the same of u+
    /// and v+ in turn.
    std::vector<double> stage_, end_;
    std::vector<double> ahead_;  ///< (i, j): the Lagrange polynomial j of the nodes at 1 + c_i
};

}  // namespace extremal
