// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of LieStep for any scalar. Included where it is instantiated: lie.cpp for double, the tests
/// for quadruple precision.
#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/action/chain_rule.hpp"
#include "engine/family/lie/lie_guess.hpp"
#include "engine/family/lie/lie_step.hpp"
#include "engine/family/lie/lie_step_tangent.hpp"

namespace extremal {

template <class T, class G>
LieStep<T, G>::LieStep(const BodyMechanics<T>& body, Table<T> table, const T& step, bool isReduced,
                       bool isAdjoint, SolverPolicy policy)
    : body_(body),
      table_(std::move(table)),
      h_(isAdjoint ? T(-step) : step),
      isUnreduced_(!body.isFree() || !isReduced),
      isAdjoint_(isAdjoint),
      policy_(policy),
      tolerance_(toleranceOf<T>(policy)),
      lagrangian_(body) {
    for (Columns* c : {&Y_, &R_, &points_}) *c = Columns::Zero(n, m());
    for (Columns* c : {&xi_, &v_, &force_}) *c = Columns::Zero(n, nodes());
    W_ = mu_ = Vector::Zero();
    const int size = n * m();
    lu_ = SmallLu<T>(size);
    flat_ = Flat::Zero(size);
    // Y from the values of xi at m points, and back.
    const std::vector<T> points = lobatto<T>(m() + 1).c;
    atPoints_ = Square(m(), m());
    std::vector<T> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
    for (int k = 0; k < m(); ++k) {
        times_.push_back(points[static_cast<std::size_t>(k + 1)]);
        table_.space.evaluate(times_.back(), value, slope);
        atPoints_.row(k) =
            Eigen::Map<const Flat>(value.data(), table_.space.size).transpose() * table_.change;
    }
    fit_ = atPoints_.partialPivLu().inverse();
    poses_.resize(static_cast<std::size_t>(m() + 1));
}

/// xi_i and xi'_i from Y.
template <class T, class G>
void LieStep<T, G>::placeNodes() {
    xi_.noalias() = Y_.lazyProduct(table_.value.transpose());
    v_.noalias() = Y_.lazyProduct(table_.derivative.transpose());
    v_ /= h_;
}

/// The base point of the adjoint step follows from the unknowns.
template <class T, class G>
void LieStep<T, G>::placeFoot() {
    if (!isAdjoint_) return;
    base_ = G::place(known_, G::element(known_), -Y_.col(m() - 1));
    baseElement_ = G::element(base_);
}

/// Y of the curve through guessed poses at the m points; false where the step is so long that there is none.
template <class T, class G>
bool LieStep<T, G>::predict() {
    poses_[0] = known_;
    poses_[0].momentum = mu_.template head<3>();
    const T step = isAdjoint_ ? T(-h_) : h_;
    for (int k = 0; k < m(); ++k) {
        const auto at = static_cast<std::size_t>(k);
        poses_[at + 1] =
            guessedAfter(body_, poses_[at], T((times_[at] - (k > 0 ? times_[at - 1] : T(0))) * step));
    }
    // The points are symmetric in time: the adjoint step sees the same ones from the end.
    const auto last = static_cast<std::size_t>(m());
    const Pose<T>& base = poses_[isAdjoint_ ? last : 0];
    const so3::Vector<T> w = mu_.template head<3>().cwiseQuotient(lagrangian_.inertia.template head<3>());
    for (int k = 0; k < m(); ++k) {
        const auto at = static_cast<std::size_t>(k + 1);
        const Pose<T>& place = poses_[isAdjoint_ ? last - at : at];
        const so3::Vector<T> near = (h_ * times_[at - 1]) * w;
        points_.col(k) = G::coordinates(base, place, turnBetween(base.attitude, place.attitude, near));
    }
    Y_.noalias() = points_.lazyProduct(fit_.transpose());
    using std::isfinite;
    return isfinite(Y_.squaredNorm());
}

/// R, the equations at the present Y: dL_d/dY by the chain rule, less the momentum at the end of the chart.
/// Fills force_ (as momenta at the base point) and W.
template <class T, class G>
void LieStep<T, G>::residual() {
    R_.setZero();
    W_.setZero();
    if (isUnreduced_) placeFoot();
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<1> at(xi_.col(i));
        Vector forXi, forV;
        if (!isUnreduced_) {
            lagrangian_.gradient(at, v_.col(i), forXi, forV);
        } else {
            const typename G::Element g = G::times(baseElement_, at);
            Vector f;
            if (body_.isFree()) {
                lagrangian_.gradientInSpace(g, at, v_.col(i), forXi, forV, f);
            } else {
                lagrangian_.gradient(at, v_.col(i), forXi, forV);
                body_.potential(body_.model.get(), G::rotation(g), G::position(g), nullptr, f.data(),
                                nullptr);
            }
            forXi += at.dexpTransposed(f);
            force_.col(i) = at.rotateMomentum(f);
            W_ -= (h_ * table_.weight(i)) * force_.col(i);
        }
        addGradient(m(), testAt(i), forXi, forV, [&](int a) { return R_.col(a); });
    }
    const typename G::template Chart<0> end(Y_.col(m() - 1));
    if (isAdjoint_)
        R_.col(m() - 1) -= end.dexpTransposed(mu_);
    else
        R_.col(m() - 1) -= end.dexpRightTransposed(mu_ - W_);
    // Of the attitude, a free body has a force to evaluate besides.
    report_->cost.evaluations += (isUnreduced_ && body_.isFree() ? 2 : 1) * nodes();
}

/// Adds what the potential does to the second derivatives at node i; A = dexp(xi_i).
template <class T, class G>
void LieStep<T, G>::addPotentialAt(int i, const typename G::template Chart<2>& at, const Matrix& A,
                                   Matrix& xiXi) {
    const typename G::Element g = G::times(baseElement_, at);
    Vector f;
    Matrix slope;
    body_.potential(body_.model.get(), G::rotation(g), G::position(g), nullptr, f.data(), slope.data());
    ChartLagrangian<T, G>::addPotential(at, A, f, slope, xiXi);
    auto jacobian = this->jacobian();
    const int last = n * (m() - 1);
    const Vector xiEnd = Y_.col(m() - 1);
    const typename G::template Chart<0> end(xiEnd), opposite(-xiEnd);
    if (isAdjoint_) {
        // The base point moves by -dexp(-xi_s) with the last unknown, and the node with it.
        Matrix moved;
        const Matrix base = opposite.dexpMatrix();
        for (int k = 0; k < n; ++k) moved.col(k) = -at.rotateBack(base.col(k));
        const Matrix change = A.transpose() * slope * moved;
        for (int a = 0; a < m(); ++a)
            jacobian.template block<n, n>(n * a, last) +=
                (table_.weight(i) * h_ * table_.value(i, a)) * change;
    } else {
        // dexp(-xi_s)^T dW/dxi_i
        const Matrix turned = (slope - G::precessionMatrix(f)) * A;
        Matrix change;
        for (int k = 0; k < n; ++k) change.col(k) = end.dexpRightTransposed(at.rotateMomentum(turned.col(k)));
        for (int a = 0; a < m(); ++a)
            jacobian.template block<n, n>(last, n * a) -=
                (table_.weight(i) * h_ * table_.value(i, a)) * change;
    }
}

/// dR/dY at the present Y, and its factorisation.
template <class T, class G>
Outcome LieStep<T, G>::assembleJacobian() {
    auto jacobian = this->jacobian();
    jacobian.setZero();
    if (isUnreduced_) placeFoot();
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<2> at(xi_.col(i));
        auto L = lagrangian_.second(at, v_.col(i));
        if (!body_.isFree()) addPotentialAt(i, at, L.A, L.xiXi);
        const Matrix xiV = L.vXi.transpose();
        addHessian(
            m(), m(), testAt(i),
            [&](int c) {
                return TrialFunction<T>{table_.value(i, c), table_.derivative(i, c)};
            },
            L.xiXi, xiV, L.vXi, L.vv,
            [&](int a, int c) { return jacobian.template block<n, n>(n * a, n * c); });
    }
    const typename G::template Chart<1> end(Y_.col(m() - 1));
    const int last = n * (m() - 1);
    jacobian.template block<n, n>(last, last) -=
        isAdjoint_ ? end.derivativeOfTransposed(mu_) : end.derivativeOfRightTransposed(mu_ - W_);
    report_->cost.evaluations += nodes();
    ++report_->cost.linearSolves;
    // Inertias far apart make pivots far apart; only what is lost in round-off is singular.
    switch (lu_.factorise()) {
        case SmallLu<T>::Result::regular:
            break;
        case SmallLu<T>::Result::singular:
            return Outcome::singular;
        case SmallLu<T>::Result::notFinite:
            return Outcome::notFinite;
    }
    return Outcome::converged;
}

/// Solves for the correction of Y from R, in flat_; returns its size relative to the unknowns.
template <class T, class G>
T LieStep<T, G>::correction() {
    for (int a = 0; a < m(); ++a) flat_.template segment<n>(n * a) = -R_.col(a);
    lu_.solve(flat_.data());
    ++report_->cost.linearSolves;
    T size(0), scale(0);
    using std::abs;
    for (int a = 0; a < m(); ++a)
        for (int k = 0; k < n; ++k) {
            const T d = abs(flat_(n * a + k));
            if (!(d <= std::numeric_limits<T>::max())) return std::numeric_limits<T>::infinity();
            size = std::max(size, d);
            scale = std::max(scale, T(abs(Y_(k, a))));
        }
    return scale > T(0) ? T(size / scale) : size;
}

/// What round-off in the equations leaves of the corrections: they are momenta of the heaviest axis, or of
/// the whole body on its way, and move the lightest axis.
template <class T, class G>
T LieStep<T, G>::floor() const {
    T heaviest = lagrangian_.inertia.template head<3>().maxCoeff();
    if constexpr (n == 6)
        for (int a = 0; a < m(); ++a)
            heaviest =
                std::max(heaviest, T(lagrangian_.inertia(3) * Y_.col(a).template tail<3>().squaredNorm()));
    return std::numeric_limits<T>::epsilon() * heaviest / lagrangian_.inertia.template head<3>().minCoeff();
}

template <class T, class G>
void LieStep<T, G>::correct() {
    if constexpr (n == 3) {
        for (int a = 0; a < m(); ++a) Y_.col(a) += flat_.template segment<n>(n * a);
    } else {
        points_.noalias() = Y_.lazyProduct(atPoints_.transpose());
        for (int k = 0; k < m(); ++k) {
            Vector change = Vector::Zero();
            for (int a = 0; a < m(); ++a) change += atPoints_(k, a) * flat_.template segment<n>(n * a);
            points_.col(k) = G::corrected(points_.col(k), change);
        }
        Y_.noalias() = points_.lazyProduct(fit_.transpose());
    }
    placeNodes();
}

/// force_ and W at the present Y.
template <class T, class G>
void LieStep<T, G>::updateImpulse() {
    W_.setZero();
    placeFoot();
    if (body_.isFree()) return;
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<0> at(xi_.col(i));
        const typename G::Element g = G::times(baseElement_, at);
        Vector f;
        body_.potential(body_.model.get(), G::rotation(g), G::position(g), nullptr, f.data(), nullptr);
        force_.col(i) = at.rotateMomentum(f);
        W_ -= (h_ * table_.weight(i)) * force_.col(i);
    }
    report_->cost.evaluations += nodes();
}

/// Newton's method from the predicted curve. Light axes stop further away from round-off than others: with a
/// new Jacobian, floor() is what they can reach.
template <class T, class G>
Outcome LieStep<T, G>::iterate(const std::stop_token& stop) {
    NewtonPolicy<T> policy(NewtonLimits<T>::lieStep(tolerance_));
    placeNodes();
    Outcome assembled = assembleJacobian();
    if (assembled != Outcome::converged) return assembled;
    for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        residual();
        const T size = correction();
        ++report_->cost.iterations;
        report_->residual = static_cast<double>(size);
        if (!(size < std::numeric_limits<T>::infinity())) return Outcome::notFinite;
        correct();
        const NewtonVerdict verdict = policy.judge(size, policy.isJacobianNew() ? floor() : T(0));
        if (const auto end = endOf(verdict)) {
            if (*end == Outcome::converged) updateImpulse();
            return *end;
        }
        if (verdict != NewtonVerdict::slow) continue;
        assembled = assembleJacobian();
        if (assembled != Outcome::converged)
            return assembled == Outcome::notFinite ? Outcome::diverged : assembled;
        policy.jacobianIsNew();
    }
    return Outcome::diverged;
}

template <class T, class G>
Outcome LieStep<T, G>::advance(Pose<T>& pose, StepReport& report, const std::stop_token& stop) {
    report_ = &report;
    known_ = base_ = pose;
    baseElement_ = G::element(known_);
    mu_ = G::bodyMomentum(baseElement_, known_);
    if (!predict()) return isRateFinite(body_, poses_[0]) ? Outcome::diverged : Outcome::notFinite;
    const Outcome solved = iterate(stop);
    if (solved != Outcome::converged) return solved;
    // Beyond, the chart folds over itself at 2 pi, and the solution is hardly the wanted one.
    const Vector xiEnd = Y_.col(m() - 1);
    if (xiEnd.template head<3>().squaredNorm() > T(25)) return Outcome::diverged;
    if (isAdjoint_) {
        G::fetch(base_, baseElement_, W_, known_);
        pose = base_;
    } else {
        Pose<T> end = G::place(base_, baseElement_, xiEnd);
        G::carry(base_, baseElement_, W_, end);
        pose = end;
    }
    return Outcome::converged;
}

template <class T, class G>
Pose<T> LieStep<T, G>::denseOutput(const T& tau) const {
    const T s = isAdjoint_ ? T(1) - tau : tau;
    std::vector<T> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
    table_.space.evaluate(s, value, slope);
    const Flat phi = table_.change.transpose() * Eigen::Map<const Flat>(value.data(), table_.space.size);
    const Vector xi = Y_ * phi;
    Vector W = Vector::Zero();
    if (isUnreduced_) {
        const std::vector<T> share = weightsUpTo(table_, s);
        for (int i = 0; i < nodes(); ++i) W -= (h_ * share[static_cast<std::size_t>(i)]) * force_.col(i);
    }
    Pose<T> at = G::place(base_, baseElement_, xi);
    G::carry(base_, baseElement_, W, at);
    return at;
}

}  // namespace extremal
