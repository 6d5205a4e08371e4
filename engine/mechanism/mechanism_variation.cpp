// SPDX-License-Identifier: GPL-3.0-or-later
/// Of Mechanism: what a projection and forces do to variations of a state.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mechanism/mechanism.hpp"

namespace extremal {

bool Mechanism::transposeProjection(double t, const double* q, const Vector& v, const Vector& kappa,
                                    Eigen::Map<Eigen::MatrixXd> columns) {
    using Matrix = Eigen::MatrixXd;
    const int d = dimension();
    Matrix dq = Matrix::Identity(d, 2 * d), dp = Matrix::Zero(d, 2 * d);
    dp.rightCols(d).setIdentity();
    if (!varyProjection(t, q, v, kappa, dq, Eigen::RowVectorXd::Zero(2 * d), dp)) return false;
    const Matrix given = columns.bottomRows(d);
    columns.bottomRows(d).setZero();
    columns += dp.transpose() * given;
    return true;
}

void Mechanism::rateAlong(double t, const double* q, const Vector& v, const Vector& dq, Vector& to) {
    const int d = dimension(), g = holonomic();
    to.setZero();
    if (const auto& part = constraint(); part && !dq.isZero(0)) {
        // r(v) = v^T g_qq v + 2 g_qt v + g_tt: r(v + w) - r(v - w) = 4 (v^T g_qq + g_qt^T) w, for a w as long
        // as v.
        const double length = v.norm() > 0 ? v.norm() : 1, scale = length / dq.norm();
        const Vector ahead = v + scale * dq, behind = v - scale * dq;
        Vector first(g), second(g);
        part->rates(part->model.get(), t, q, ahead.data(), first.data());
        part->rates(part->model.get(), t, q, behind.data(), second.data());
        to.head(g) = (first - second) / (4 * scale);
    }
    if (const auto& part = rolling()) {
        const int n = part->count();
        Vector value(n), byTime(n);
        Rows byState(n, 2 * d);
        part->first(part->model.get(), t, q, v.data(), value.data(), byState.data(), byTime.data());
        to.tail(n) = byState.leftCols(d) * dq;
    }
}

void Mechanism::byTimeOfConditions(double t, const double* q, const Vector& v, const Vector& kappa,
                                   Vector& reaction, Vector& rate) {
    const int d = dimension(), n = constraints();
    const double apart = 1e-5 * std::max(1.0, std::abs(t));
    Vector value(n), byTime(n);
    Rows byPlace = Rows::Zero(n, d);
    reaction = Vector::Zero(d);
    rate = Vector::Zero(n);
    for (const double sign : {1.0, -1.0}) {
        conditions(t + sign * apart, q, value, byPlace, byTime);
        reaction += sign / (2 * apart) * (byPlace.transpose() * kappa);
        rate += sign / (2 * apart) * (byPlace * v + byTime);
    }
}

bool Mechanism::varyProjection(double t, const double* q, const Vector& v, const Vector& kappa,
                               const Eigen::MatrixXd& dq, const Eigen::RowVectorXd& dt, Eigen::MatrixXd& dp) {
    const int d = dimension(), n = constraints(), g = holonomic();
    if (n == 0) return true;
    Rows curvature = Rows::Zero(d, d);
    if (const auto& part = constraint())
        part->addCurvature(part->model.get(), t, q, kappa.data(), curvature.data());
    if (const auto& part = rolling())
        part->addCurvature(part->model.get(), t, q, kappa.data() + g, curvature.data());
    Vector reactionByTime, rateByTime, momentumByTime = Vector::Zero(d);
    if (!dt.isZero(0)) {
        byTimeOfConditions(t, q, v, kappa, reactionByTime, rateByTime);
        if (mechanics_.isTimeDependent) {
            const double apart = 1e-5 * std::max(1.0, std::abs(t));
            for (const double sign : {1.0, -1.0}) {
                mechanics_.gradient(mechanics_.model.get(), t + sign * apart, q, v.data(), ahead_.data());
                momentumByTime += sign / (2 * apart) * ahead_.tail(d);
            }
        }
    }
    state_->evaluate(t, q, v.data());
    if (!state_->factorise()) return false;
    Vector x(d + n), moved(d), rate(n);
    for (Eigen::Index c = 0; c < dq.cols(); ++c) {
        moved = dq.col(c);
        // What the reaction is moved by with the multipliers fixed.
        dp.col(c) += curvature * moved;
        state_->massRate(moved.data(), sum_);
        rateAlong(t, q, v, moved, rate);
        x.head(d) = dp.col(c) - sum_;
        x.tail(n) = -rate;
        if (dt(c) != 0) {
            dp.col(c) += dt(c) * reactionByTime;
            x.head(d) += dt(c) * (reactionByTime - momentumByTime);
            x.tail(n) -= dt(c) * rateByTime;
        }
        state_->solve(x);
        if (!x.allFinite()) return false;
        state_->reaction(x.tail(n), sum_);
        dp.col(c) += sum_;
    }
    return true;
}

double Mechanism::expansion(double t, const double* q, const double* v) {
    if (!force_) return 0;
    const int d = dimension();
    Rows byState = Rows::Zero(d, 2 * d);
    Vector value(d), x(d + constraints());
    force_->first(force_->model.get(), t, q, v, value.data(), byState.data());
    state_->evaluate(t, q, v);
    if (!state_->factorise()) return std::numeric_limits<double>::quiet_NaN();
    double trace = 0;
    for (int k = 0; k < d; ++k) {
        const auto column = byState.col(d + k);
        if (column.isZero(0)) continue;
        x.head(d) = column;
        x.tail(constraints()).setZero();
        state_->solve(x);
        trace += x(k);
    }
    return trace;
}

}  // namespace extremal
