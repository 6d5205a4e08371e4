// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/rolling_rows.hpp"

namespace extremal {

RollingRows::RollingRows(const Rolling& rolling, const MechanismCurve& curve)
    : rolling_(rolling), curve_(curve) {
    const int d = curve_.d, m = curve_.unknowns(), n = count();
    motion_ = Vector::Zero(2 * d);
    byTime_ = unused_ = Vector::Zero(n);
    value_ = Matrix::Zero(n, m);
    reaction_.assign(static_cast<std::size_t>(m), Rows::Zero(n, d));
    byState_.assign(static_cast<std::size_t>(m), Rows::Zero(n, 2 * d));
    atRest_ = Rows::Zero(n, 2 * d);
    curvature_ = Rows::Zero(d, d);
}

void RollingRows::evaluate(double t, double h, const Vector& z) {
    const int d = curve_.d;
    t_ = t;
    h_ = h;
    motion_.tail(d).setZero();
    for (int j = 0; j < curve_.unknowns(); ++j) {
        curve_.placeAt(z, curve_.atRolling, j, motion_);
        rolling_.first(rolling_.model.get(), timeOfReaction(j), motion_.data(), motion_.data() + d,
                       unused_.data(), atRest_.data(), byTime_.data());
        reaction_[static_cast<std::size_t>(j)] = atRest_.rightCols(d);
    }
    for (int j = 0; j < curve_.unknowns(); ++j) {
        curve_.motionAt(curve_.atGauss, z, j, h, motion_);
        rolling_.first(rolling_.model.get(), t + curve_.atGauss.place(j) * h, motion_.data(),
                       motion_.data() + d, value_.col(j).data(), byState_[static_cast<std::size_t>(j)].data(),
                       byTime_.data());
    }
}

const RollingRows::Rows& RollingRows::curvature(int j, const Vector& z, const double* M) {
    curve_.placeAt(z, curve_.atRolling, j, motion_);
    curvature_.setZero();
    rolling_.addCurvature(rolling_.model.get(), timeOfReaction(j), motion_.data(), M, curvature_.data());
    return curvature_;
}

}  // namespace extremal
