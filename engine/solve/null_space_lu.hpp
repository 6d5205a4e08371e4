// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear system of a step whose constraints hold node by node, solved on what they leave free:
///     sum_k M_jk u_k + G_j^T lambda_j = r_j,    G_{j+1} u_j = c_j,    j, k = 0..m-1,
/// for d unknowns u_j and n < d multipliers lambda_j at each of m nodes; G_j, j = 0..m, are n x d.
///
/// G_j has n coordinates that depend on the other d - n: found by elimination with complete pivoting, they
/// give a basis N_j of what G_j does not see. With u_j = N_{j+1} x_j + what c_j alone takes, and the sums
/// tested by N_j, there remain m (d - n) unknowns x in place of m (d + n); multipliers follow node by node.
/// Of a mechanism with one freedom of four coordinates that is a seventh of the unknowns.
///
/// Shapes: numbers of one node and coordinate are coordinate by coordinate, u_j(k) at k m + j; those of one
/// constraint node by node, c_j(i) at j n + i. Nothing is allocated after the constructor.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/core/algebra/small_product.hpp"
#include "engine/core/outcome.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {

class NullSpaceLu {
public:
    /// Whether there is less to do than with all unknowns together: finding bases takes the place of what
    /// constraints add to these.
    static bool isWorthwhile(int d, int n) { return n < d && 3 * n >= d; }

    NullSpaceLu(int m, int d, int n);

    /// To be set before factorise(): column (k m + j) of M, and G_j row by row.
    double* column(int k, int j) { return matrix_.col(k * m_ + j).data(); }
    double* constraints(int j) { return &given_[static_cast<std::size_t>(j * n_ * d_)]; }
    void clear() { matrix_.setZero(); }

    /// Singular where constraints depend on each other, or the motions they leave are not determined.
    Outcome factorise();
    /// Replaces (r, c) by (u, lambda).
    void solve(double* curve, double* multipliers);
    /// The same of the transposed system: rows of u are then those of M^T and G_{j+1}^T, and those of lambda
    /// of G_j.
    void solveTransposed(double* curve, double* multipliers);

private:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    bool eliminate(int node);
    /// What is known of one node: coordinates, the n dependent ones first; the inverse of their part of G;
    /// and that times the other part.
    const int* order(int node) const { return &order_[static_cast<std::size_t>(node * d_)]; }
    double inverse(int node, int i, int c) const {
        return eliminated_[static_cast<std::size_t>((node * n_ + i) * (d_ + n_) + d_ + c)];
    }
    double dependence(int node, int i, int f) const {
        return eliminated_[static_cast<std::size_t>((node * n_ + i) * (d_ + n_) + order(node)[n_ + f])];
    }
    // Of curves of m nodes, which are those from `first` on.
    void placeDependent(int first, const double* multipliers, double* curve) const;
    void addFree(int first, const double* free, double* curve) const;
    void restrict(int first, const double* curve, double* free) const;
    void multipliersOf(int first, const double* curve, double* multipliers) const;

    int m_, d_, n_;
    NodeSums sums_ = nodeSums();
    Matrix matrix_, ofFree_;  ///< M, and M N; in whole registers
    std::vector<double> given_, eliminated_;
    std::vector<int> order_;
    SmallLu<double> lu_;
    Vector free_, curve_, rest_;
};

}  // namespace extremal
