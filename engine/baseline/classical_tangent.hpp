// SPDX-License-Identifier: GPL-3.0-or-later
/// The tangent map of the classical Runge-Kutta step: the same stages of the variational equation W' = f'(x)
/// W, whose step is the derivative of the step of x.
#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "engine/baseline/classical_table.hpp"

namespace extremal {

class ClassicalTangent {
public:
    /// W <- M W of a step h. `jacobianAt(h c_i)`, called once for each stage in turn,
    /// moves on to x_0 + h c_i f(last stage) and returns f' there, or null.
    template <class JacobianAt>
    bool apply(double h, Eigen::Map<Eigen::MatrixXd> W, JacobianAt&& jacobianAt) {
        using classical::node, classical::weight;
        sum_.setZero(W.rows(), W.cols());
        slope_.setZero(W.rows(), W.cols());
        for (std::size_t i = 0; i < classical::stages; ++i) {
            const Eigen::MatrixXd* const jacobian = jacobianAt(node[i] * h);
            if (!jacobian) return false;
            at_ = W + node[i] * h * slope_;
            slope_.noalias() = jacobian->lazyProduct(at_);
            sum_ += weight[i] * slope_;
        }
        W += h * sum_;
        return true;
    }

private:
    Eigen::MatrixXd sum_, slope_, at_;
};

}  // namespace extremal
