// SPDX-License-Identifier: GPL-3.0-or-later
/// The augmented action of N elements, nothing condensed: every element has its own degrees of freedom z_k in
/// the basis of the space, and multipliers join them,
///     A = sum_k S(z_k) + p_0 . (s-(z_0) - q_0) + sum_{k=1}^{N-1} p_k . (s-(z_k) - s+(z_{k-1})) - p_N .
///     (s+(z_{N-1}) - q_N).
/// Its stationarity conditions are the KKT conditions of the discrete action under continuity,
///     dS/dz_k + (Ds-)^T p_k - (Ds+)^T p_{k+1} = 0,    s-(z_k) = s+(z_{k-1}),
/// for fixed ends q_0 and q_N; the multipliers are the momenta. The matrix is symmetric and indefinite.
///
/// Unknowns in the order of time: p_0, z_0, p_1, z_1, ..., z_{N-1}, p_N; entry (a, i) of z_k, function a and
/// coordinate i, is at place a d + i of its block. This is the definition; steps solve a condensed form of it
/// (action/table.hpp), and figures of sparsity show it. Source: Leok 2004, sec. 2.1; the second condition
/// printed there has a wrong element index.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/action/element_kernel.hpp"
#include "engine/action/table.hpp"
#include "engine/action/unknown_block.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

class SaddlePoint {
public:
    /// Elements of length h. The table says space and rule; its change of basis is not used.
    SaddlePoint(Mechanics<double> mechanics, const Table<double>& table, double h, int elements);

    int dimension() const { return kernel_.dimension(); }
    int elements() const { return elements_; }
    int size() const { return (elements_ + 1) * dimension() + elements_ * elementSize(); }
    int elementSize() const { return kernel_.size(); }
    int functions() const { return kernel_.functions(); }
    std::vector<UnknownBlock> blocks() const;
    int multiplierOffset(int k) const { return k * (dimension() + elementSize()); }
    int elementOffset(int k) const { return multiplierOffset(k) + dimension(); }

    /// The gradient of A at x, and its Hessian if asked for. False where they are not finite.
    bool assemble(double t0, const Eigen::VectorXd& q0, const Eigen::VectorXd& qN, const Eigen::VectorXd& x,
                  Eigen::VectorXd& gradient, Eigen::MatrixXd* hessian) const;

    /// z_k of all elements on straight lines between the nodes, d x (N + 1); multipliers 0.
    Eigen::VectorXd broken(const Eigen::MatrixXd& nodes) const;

private:
    ElementKernel<double> kernel_;  ///< in the basis of the space
    double h_;
    int elements_;
    Eigen::VectorXd start_, end_;  ///< traces of the basis
    Eigen::VectorXd one_, rise_;   ///< coefficients of the functions 1 and (0 at the start, 1 at the end)
};

}  // namespace extremal
