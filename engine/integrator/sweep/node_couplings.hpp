// SPDX-License-Identifier: GPL-3.0-or-later
/// How the nodes of a step see each other, where the velocities at the nodes are its unknowns
/// (velocity_iteration.hpp): a partitioned Runge-Kutta method, with weights w_j = h b_j,
///     q(c_i) = q_0 + sum_j mu_ij w_j v_j,       p(c_i) = p_0 + sum_j nu_ij w_j F_j,      nu_ij = 1 - mu_ji.
/// Both matrices are multiples of one unit, so that they add up to 1 to the last bit and the step is
/// symplectic to the last bit (Antonana, Makazaga and Murua, Numer. Algorithms 76 (2017)).
///
/// T: scalar. Arrays are by node, padded to whole lanes; matrices by columns. The lanes beyond the last node
/// repeat it.
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "engine/action/table.hpp"

namespace extremal {

template <class T>
struct NodeCouplings {
    using Array = std::vector<T>;

    int nodes, stride;
    Array node, b;  ///< c_i; b_i, 0 beyond the nodes
    Array mu, nu;   ///< by columns
    Array onward;   ///< by columns: weight of v_j in its extrapolation to 1 + c_i
    Array toY;      ///< D^-1 by columns: Y_a = h sum_i toY_ai v_i

    explicit NodeCouplings(const Table<T>& table);

    std::size_t at(int k, int i) const { return static_cast<std::size_t>(k * stride + i); }

    /// The sum of w_j v_j, or of w_j F_j, which are 0 beyond the nodes; what rounding takes from it is added
    /// to the carry. Rounded in double it would be biased.
    void addUp(const T* parts, T& sum, T& carry) const {
        using Accumulator = std::conditional_t<std::is_same_v<T, double>, long double, T>;
        Accumulator sums[2] = {Accumulator(0), Accumulator(0)};  // two, as each waits for its last sum
        for (int i = 0; i < stride; i += 2)
            for (int l = 0; l < 2; ++l) sums[l] += Accumulator(parts[i + l]);
        const Accumulator all = sums[0] + sums[1];
        sum = static_cast<T>(all);
        carry += static_cast<T>(all - Accumulator(sum));
    }
};

}  // namespace extremal
