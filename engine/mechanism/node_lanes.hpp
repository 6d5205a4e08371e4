// SPDX-License-Identifier: GPL-3.0-or-later
/// The nodes of a rule side by side, for what is evaluated at all of them together.
///
/// Arrays of a node are columns of matrices: entry k of node i at k * stride() + i, as the calls of
/// model/mechanics.hpp and model/parts for many nodes have it. The stride is a multiple of 8; the rows behind
/// the last node repeat it.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/core/algebra/small_product.hpp"
#include "engine/mechanism/mechanism_curve.hpp"

namespace extremal {

class NodeLanes {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    /// Nodes with the functions there, row by row; without slopes there are no velocities.
    NodeLanes(const std::vector<double>& places, const MechanismCurve::Samples& at, int dimension);

    int nodes() const { return nodes_; }
    int stride() const { return static_cast<int>(places_.size()); }
    /// Room for so many entries of each node.
    Matrix room(int entries) {
        if (entries_.size() < entries) entries_ = Vector::Zero(entries);
        return Matrix::Zero(stride(), entries);
    }

    /// Moves the nodes to q = q_0 + sum_a phi_a Y_a in a step of length h from t; Y: m x d.
    void moveTo(double t, double h, const double* q0, const Matrix& Y);
    const double* times() const { return times_.data(); }
    const double* q() const { return motion_.data(); }
    const double* v() const { return motion_.col(d_).data(); }

    /// `call(t, q, v, entries)` at one node after the other, for parts without a call for many; `to` has been
    /// made by room().
    template <class Call>
    void oneByOne(Matrix& to, const Call& call) {
        for (int i = 0; i < nodes_; ++i) {
            const double* const at = placeOf(i);
            call(times_(i), at, at + d_, entries_.data());
            to.row(i) = entries_.head(to.cols()).transpose();
        }
    }
    /// The place of node i, with its velocity behind it.
    const double* placeOf(int i) {
        own_ = motion_.row(i).transpose();
        return own_.data();
    }

private:
    int nodes_, d_;
    NodeSums sums_ = nodeSums();
    Vector places_, times_;
    Matrix functions_;      ///< (i, a): values, and slopes below them, in whole registers
    Matrix motion_;         ///< (q, v) of the nodes, side by side
    Vector own_, entries_;  ///< of one node
};

/// Sums over nodes with the test functions of a step: chi_a = phi_a (a < m - 1), chi_{m-1} = 1 - phi_{m-1},
/// and the function 1 behind these.
class NodeTests {
public:
    using Matrix = Eigen::MatrixXd;

    /// `weights`: one for each node that is summed over, the first ones of the samples.
    NodeTests(const std::vector<double>& weights, const MechanismCurve::Samples& at);

    /// to(a, c) += sum_i w_i chi_a(i) data(i, c), or with chi_a', for all rows of `to`.
    void addValues(const double* data, int stride, Matrix& to) const { add(value_, data, stride, to); }
    void addSlopes(const double* data, int stride, Matrix& to) const { add(slope_, data, stride, to); }
    /// w_i chi_a(i) and w_i chi_a'(i), row by row.
    const Matrix& value() const { return value_; }
    const Matrix& slope() const { return slope_; }

private:
    void add(const Matrix& tests, const double* data, int stride, Matrix& to) const;

    NodeSums sums_ = nodeSums();
    Matrix value_, slope_;  ///< (a, i), in whole registers
};

/// Sums over nodes with the product of a test function and a function of the space: to(a, b) +=
/// sum_i w_i chi_a(i) phi_b(i) data(i), or with their derivatives.
class NodePairs {
public:
    using Matrix = Eigen::MatrixXd;

    /// `tests` of m + 1 rows, functions at the first nodes of the samples.
    NodePairs(const Matrix& tests, const Matrix& functions);

    /// Adds the sums with weight * data to `to`, (m + 1) x m; false where all data are 0.
    bool add(const double* data, double weight, Matrix& to);

private:
    NodeSums sums_ = nodeSums();
    Matrix products_;  ///< (a + b (m + 1), i), in whole registers
    Eigen::VectorXd weighted_;
};

}  // namespace extremal
