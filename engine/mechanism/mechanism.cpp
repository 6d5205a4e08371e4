// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class Part>
std::optional<Part> copyOf(const Parts& parts) {
    const Part* const part = parts.find<Part>();
    return part ? std::optional<Part>(*part) : std::nullopt;
}

}  // namespace

Mechanism::Mechanism(const Parts& parts)
    : mechanics_(*parts.find<Mechanics<double>>()),
      constraint_(copyOf<Constraint>(parts)),
      force_(copyOf<Force>(parts)),
      rolling_(copyOf<Rolling>(parts)) {
    const int d = dimension(), n = constraints();
    lu_ = SmallLu<double>(d + n);
    hessian_ = Rows::Zero(2 * d, 2 * d);
    byPlace_ = Rows::Zero(n, d);
    gradient_ = Vector::Zero(2 * d);
    for (Vector* v : {&value_, &byTime_, &rates_}) *v = Vector::Zero(n);
    forces_ = velocity_ = byTimeOfMomentum_ = Vector::Zero(d);
    rhs_ = Vector::Zero(d + n);
    rest_ = Vector::Zero(d);
    rollingValue_ = rollingByTime_ = Vector::Zero(n - holonomic());
    rollingByState_ = Rows::Zero(n - holonomic(), 2 * d);
}

void Mechanism::conditions(double t, const double* q, Vector& value, Rows& byPlace, Vector& byTime) {
    if (constraint_)
        constraint_->first(constraint_->model.get(), t, q, value.data(), byPlace.data(), byTime.data());
    if (!rolling_) return;
    const int d = dimension(), n = rolling_->count();
    rolling_->first(rolling_->model.get(), t, q, rest_.data(), rollingValue_.data(), rollingByState_.data(),
                    rollingByTime_.data());
    value.tail(n).setZero();
    byPlace.bottomRows(n) = rollingByState_.rightCols(d);
    byTime.tail(n) = rollingValue_;
}

/// L'', L', F and the first derivatives of g.
void Mechanism::evaluate(double t, const double* q, const double* v) {
    double value = 0;
    mechanics_.jet(mechanics_.model.get(), t, q, v, &value, gradient_.data(), hessian_.data());
    forces_.setZero();
    if (force_) force_->value(force_->model.get(), t, q, v, forces_.data());
    conditions(t, q, value_, byPlace_, byTime_);
}

/// [ L_vv, -g_q^T; g_q, 0 ] from what was evaluated last.
bool Mechanism::factoriseSaddle() {
    const int d = dimension(), n = constraints();
    for (int j = 0; j < d + n; ++j) {
        double* const column = lu_.column(j);
        for (int i = 0; i < d; ++i) column[i] = j < d ? hessian_(d + i, d + j) : -byPlace_(j - d, i);
        for (int k = 0; k < n; ++k) column[d + k] = j < d ? byPlace_(k, j) : 0;
    }
    return lu_.factorise() == SmallLu<double>::Result::regular;
}

bool Mechanism::accelerate(double t, const double* q, const double* v, Vector& acceleration,
                           Vector& multipliers) {
    const int d = dimension(), n = constraints();
    byTimeOfMomentum_.setZero();
    if (mechanics_.isTimeDependent) {
        const double apart = 1e-6 * std::max(1.0, std::abs(t));
        mechanics_.gradient(mechanics_.model.get(), t + apart, q, v, gradient_.data());
        byTimeOfMomentum_ = gradient_.tail(d);
        mechanics_.gradient(mechanics_.model.get(), t - apart, q, v, gradient_.data());
        byTimeOfMomentum_ = (byTimeOfMomentum_ - gradient_.tail(d)) / (2 * apart);
    }
    evaluate(t, q, v);
    if (constraint_) constraint_->rates(constraint_->model.get(), t, q, v, rates_.data());
    const Eigen::Map<const Vector> velocity(v, d);
    if (rolling_) {
        rolling_->first(rolling_->model.get(), t, q, v, rollingValue_.data(), rollingByState_.data(),
                        rollingByTime_.data());
        rates_.tail(rolling_->count()) = rollingByState_.leftCols(d) * velocity + rollingByTime_;
    }
    rhs_.head(d) =
        gradient_.head(d) + forces_ - hessian_.bottomLeftCorner(d, d) * velocity - byTimeOfMomentum_;
    rhs_.tail(n) = -rates_;
    if (!factoriseSaddle()) return false;
    lu_.solve(rhs_.data());
    acceleration = rhs_.head(d);
    multipliers = rhs_.tail(n);
    return rhs_.allFinite();
}

bool Mechanism::project(double t, const double* q, double* p, Vector& v, Vector& kappa, bool knowsVelocity) {
    constexpr int mostIterations = 30;
    const int d = dimension(), n = constraints();
    kappa = Vector::Zero(n);
    if (v.size() != d) v = Vector::Zero(d);
    if (!knowsVelocity && !mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return false;
    if (n == 0) return true;
    const Vector given = Eigen::Map<const Vector>(p, d);
    // Of the velocities on the way: where they end at 0, their round-off is that of those before.
    double last = std::numeric_limits<double>::infinity(), scale = v.cwiseAbs().maxCoeff();
    for (int iteration = 0; iteration < mostIterations; ++iteration) {
        evaluate(t, q, v.data());
        rhs_.head(d) = given + byPlace_.transpose() * kappa - gradient_.tail(d);
        rhs_.tail(n) = -(byPlace_ * v + byTime_);
        if (!factoriseSaddle()) return false;
        lu_.solve(rhs_.data());
        if (!rhs_.allFinite()) return false;
        v += rhs_.head(d);
        kappa += rhs_.tail(n);
        const double size = rhs_.head(d).cwiseAbs().maxCoeff();
        scale = std::max(scale, v.cwiseAbs().maxCoeff());
        if (size <= 4 * epsilon * scale || (size >= last / 4 && size <= 1e-10 * scale)) break;
        if (iteration + 1 == mostIterations) return false;
        last = size;
    }
    const Vector change = byPlace_.transpose() * kappa;
    for (int i = 0; i < d; ++i) p[i] = given(i) + change(i);
    return true;
}

std::optional<double> Mechanism::strike(double t, const double* q, double* p, const double* normal,
                                        double target) {
    constexpr int mostIterations = 30;
    const int d = dimension(), n = constraints(), size = d + n + 1;
    const Vector given = Eigen::Map<const Vector>(p, d);
    const Eigen::Map<const Vector> along(normal, d);
    Vector v(d);
    if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return {};
    Vector reactions = Vector::Zero(n + 1), residual(size);
    Eigen::MatrixXd matrix(size, size), rows(n + 1, d);
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < mostIterations; ++iteration) {
        evaluate(t, q, v.data());
        rows.topRows(n) = byPlace_;
        rows.row(n) = along.transpose();
        matrix << hessian_.bottomRightCorner(d, d), -rows.transpose(), rows,
            Eigen::MatrixXd::Zero(n + 1, n + 1);
        residual.head(d) = given + rows.transpose() * reactions - gradient_.tail(d);
        residual.segment(d, n) = -(byPlace_ * v + byTime_);
        residual(size - 1) = target - along.dot(v);
        const Vector change = dense::solve<double>(matrix, Eigen::MatrixXd(residual)).col(0);
        if (!change.allFinite()) return {};
        v += change.head(d);
        reactions += change.tail(n + 1);
        const double step = change.head(d).cwiseAbs().maxCoeff(), scale = v.cwiseAbs().maxCoeff();
        if (step <= 4 * epsilon * scale || (step >= last / 4 && step <= 1e-10 * scale)) {
            const Vector impulse = rows.transpose() * reactions;
            for (int i = 0; i < d; ++i) p[i] = given(i) + impulse(i);
            return reactions(n);
        }
        last = step;
    }
    return {};
}

bool Mechanism::projectPlace(double t, double* q) {
    constexpr int mostIterations = 50;
    const int d = dimension(), n = constraints();
    if (n == 0) return true;
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < mostIterations; ++iteration) {
        velocity_.setZero();
        evaluate(t, q, velocity_.data());
        rhs_.head(d).setZero();
        rhs_.tail(n) = -value_;
        if (!factoriseSaddle()) return false;
        lu_.solve(rhs_.data());
        if (!rhs_.allFinite()) return false;
        double scale = 0, size = 0;
        for (int i = 0; i < d; ++i) {
            q[i] += rhs_(i);
            scale = std::max(scale, std::abs(q[i]));
            size = std::max(size, std::abs(rhs_(i)));
        }
        if (size <= epsilon * scale || (size >= last / 4 && size <= 1e-12 * scale)) return true;
        last = size;
    }
    return false;
}

bool Mechanism::flow(double t, const double* q, const double* p, double* qdot, double* pdot) {
    const int d = dimension();
    if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, qdot)) return false;
    if (constraints() == 0) {
        mechanics_.gradient(mechanics_.model.get(), t, q, qdot, gradient_.data());
        if (force_) force_->value(force_->model.get(), t, q, qdot, forces_.data());
        for (int i = 0; i < d; ++i) pdot[i] = gradient_(i) + (force_ ? forces_(i) : 0);
        return true;
    }
    if (!accelerate(t, q, qdot, acceleration_, multipliers_)) return false;
    Eigen::Map<Vector>(pdot, d) = gradient_.head(d) + forces_ + byPlace_.transpose() * multipliers_;
    return true;
}

double Mechanism::largestValue(double t, const double* q) {
    if (!constraint_) return 0;
    conditions(t, q, value_, byPlace_, byTime_);
    return value_.cwiseAbs().maxCoeff();
}

double Mechanism::largestRate(double t, const double* q, const double* v) {
    if (constraints() == 0) return 0;
    conditions(t, q, value_, byPlace_, byTime_);
    return (byPlace_ * Eigen::Map<const Vector>(v, dimension()) + byTime_).cwiseAbs().maxCoeff();
}

Mechanism::Rank Mechanism::rank(double t, const double* q) {
    Rank found;
    const int d = dimension(), n = constraints();
    if (n == 0) return found;
    velocity_.setZero();
    evaluate(t, q, velocity_.data());
    // Rows of unit length in the metric of the mass: then the last pivot that is left of each row, once those
    // before it are taken out, tells how much of it is its own.
    const Eigen::MatrixXd mass = hessian_.bottomRightCorner(d, d);
    const Eigen::MatrixXd back = dense::solve<double>(mass, Eigen::MatrixXd(byPlace_.transpose()));
    Eigen::MatrixXd gram = byPlace_ * back;
    const Vector size = gram.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    gram = Eigen::MatrixXd(size.asDiagonal() * gram * size.asDiagonal());
    for (int k = 0; k < n; ++k) {
        // Cholesky without pivoting, so that it is the later constraint that is named.
        for (int j = 0; j < k; ++j)
            if (gram(j, j) > 0) gram.row(k).tail(n - j) -= gram(k, j) / gram(j, j) * gram.row(j).tail(n - j);
        const double own = std::sqrt(std::max(0.0, gram(k, k)));
        if (own < found.ratio) found = {own, k};
    }
    return found;
}

}  // namespace extremal
