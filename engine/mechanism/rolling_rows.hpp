// SPDX-License-Identifier: GPL-3.0-or-later
/// Rolling conditions in the equations of a step with full matrices (mechanism_step.hpp): impulses a^T M_j at
/// the places r_j, and rows h r at the Gauss nodes, on the velocity of the curve and in the units of places.
#pragma once

#include <vector>

#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"

namespace extremal {

class RollingRows {
public:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;
    using Rows = Mechanism::Rows;

    RollingRows(const Rolling& rolling, const MechanismCurve& curve);
    int count() const { return rolling_.count(); }

    /// Evaluates a at the r_j and r at the Gauss nodes.
    void evaluate(double t, double h, const Vector& z);
    /// h r at Gauss node j.
    auto residual(int j) const { return h_ * value_.col(j); }
    /// a at r_j.
    const Rows& reaction(int j) const { return reaction_[static_cast<std::size_t>(j)]; }
    /// d(h r_k)(j) / dY_a(i).
    double rate(int j, int k, int a, int i) const {
        const Rows& byState = byState_[static_cast<std::size_t>(j)];
        return h_ * curve_.atGauss.at.value(j, a) * byState(k, i) +
               curve_.atGauss.at.slope(j, a) * byState(k, curve_.d + i);
    }
    /// The derivative of a^T M_j by the place r_j, where evaluate() was asked last.
    const Rows& curvature(int j, const Vector& z, const double* M);

private:
    double timeOfReaction(int j) const { return t_ + curve_.rolling.c[static_cast<std::size_t>(j)] * h_; }

    Rolling rolling_;
    MechanismCurve curve_;
    double t_ = 0, h_ = 0;
    Vector motion_, byTime_, unused_;
    Matrix value_;                          ///< (k, j): r_k
    std::vector<Rows> reaction_, byState_;  ///< by j
    Rows atRest_, curvature_;
};

}  // namespace extremal
