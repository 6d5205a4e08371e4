// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of LieStep for any scalar. Included where it is instantiated: lie.cpp for double, the tests
/// for quadruple precision.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/action/chain_rule.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/family/lie/lie_step.hpp"
#include "engine/family/lie/lie_step_tangent.hpp"
#include "engine/family/lie/product_jacobian.hpp"

namespace extremal {

template <class T, class G>
LieStep<T, G>::LieStep(const Mechanics& mechanics, Table<T> table, const T& step, bool isReduced,
                       bool isAdjoint, SolverPolicy policy)
    : group_(mechanics),
      table_(std::move(table)),
      h_(isAdjoint ? T(-step) : step),
      isAdjoint_(isAdjoint),
      policy_(policy),
      tolerance_(toleranceOf<T>(policy)),
      lagrangian_(mechanics),
      guess_(group_, mechanics, m()),
      charts_(chartsOf<G>(group_)) {
    isUnreduced_ = !lagrangian_.isFree() || (Lagrangian::hasSpaceForm && !isReduced);
    for (Columns* c : {&Y_, &R_, &points_}) *c = Columns::Zero(d(), m());
    for (Columns* c : {&xi_, &v_, &force_}) *c = Columns::Zero(d(), nodes());
    W_ = mu_ = forXi_ = forV_ = end_ = Vector::Zero(d());
    if constexpr (hasIsotropy) inSpace_ = W_;
    const int size = d() * m();
    if constexpr (isCoupled)
        lu_ = blocksOf(lagrangian_.couplings(), m(), false);
    else
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
    fit_ = dense::inverse<T>(atPoints_);
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
    end_ = -Y_.col(m() - 1);
    base_ = group_.place(known_, group_.element(known_), end_);
    baseElement_ = group_.element(base_);
}

/// Y of the curve through guessed poses at the m points; false where the step is so long that there is none.
template <class T, class G>
bool LieStep<T, G>::predict() {
    guess_.curve(known_, mu_, times_, isAdjoint_ ? T(-h_) : h_, isAdjoint_, points_);
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
        auto&& at = chart<1>(xi_.col(i));
        if (!isUnreduced_) {
            lagrangian_.gradient(at, v_.col(i), forXi_, forV_);
        } else {
            const typename G::Element& g = group_.times(baseElement_, at);
            const Vector& f = lagrangian_.gradient(g, at, v_.col(i), forXi_, forV_);
            force_.col(i) = at.rotateMomentum(f);
            W_ -= (h_ * table_.weight(i)) * force_.col(i);
        }
        addGradient(m(), testAt(i), forXi_, forV_, [&](int a) { return R_.col(a); });
    }
    auto&& end = chart<0>(Y_.col(m() - 1));
    if (isAdjoint_)
        R_.col(m() - 1) -= end.dexpTransposed(mu_);
    else
        R_.col(m() - 1) -= end.dexpRightTransposed(mu_ - W_);
    if constexpr (hasIsotropy)
        for (const int k : group_.isotropy()) R_.row(k) = Y_.row(k);
    // Of the attitude, a free body has a force to evaluate besides.
    report_->cost.evaluations += (isUnreduced_ && lagrangian_.isFree() ? 2 : 1) * nodes();
}

/// Adds what the force at node i does to the equations through the base point, which moves with the last
/// unknown of an adjoint step, and through W.
template <class T, class G>
void LieStep<T, G>::addForceAt(int i, const typename G::template Chart<2>& at,
                               const typename Lagrangian::ForceSlope& F) requires(!isCoupled) {
    auto jacobian = this->jacobian();
    const int last = d() * (m() - 1);
    const Vector xiEnd = Y_.col(m() - 1);
    const auto end = group_.template chart<0>(xiEnd), opposite = group_.template chart<0>(Vector(-xiEnd));
    if (isAdjoint_) {
        // The base point moves by -dexp(-xi_s) with the last unknown, and the node with it.
        Matrix moved = opposite.dexpMatrix();
        for (int k = 0; k < d(); ++k) moved.col(k) = (-at.rotateBack(moved.col(k))).eval();
        addGradient(m(), testAt(i), Matrix(F.A().transpose() * F.S() * moved), Matrix(Matrix::Zero()),
                    [&](int a) { return jacobian.template block<n, n>(d() * a, last, d(), d()); });
        return;
    }
    // dexp(-xi_s)^T dW, with what xi does to the force.
    Matrix byXi = (F.S() - group_.precessionMatrix(F.f())) * F.A();
    for (int k = 0; k < d(); ++k)
        byXi.col(k) = end.dexpRightTransposed(at.rotateMomentum(byXi.col(k))).eval();
    for (int a = 0; a < m(); ++a)
        jacobian.template block<n, n>(last, d() * a, d(), d()) -=
            (table_.weight(i) * h_ * table_.value(i, a)) * byXi;
}

/// dR/dY at the present Y.
template <class T, class G>
void LieStep<T, G>::fillJacobian() requires(!isCoupled) {
    auto jacobian = this->jacobian();
    jacobian.setZero();
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<2> at = group_.template chart<2>(xi_.col(i));
        typename Lagrangian::Second L;
        if (lagrangian_.isFree()) {
            L = lagrangian_.second(at, v_.col(i));
        } else {
            typename Lagrangian::ForceSlope F;
            L = lagrangian_.second(group_.times(baseElement_, at), at, v_.col(i), F);
            addForceAt(i, at, F);
        }
        const Matrix xiV = L.vXi.transpose();
        addHessian(m(), m(), testAt(i), trialAt(i), L.xiXi, xiV, L.vXi, L.vv,
                   [&](int a, int c) { return jacobian.template block<n, n>(d() * a, d() * c, d(), d()); });
    }
    const auto end = group_.template chart<1>(Y_.col(m() - 1));
    const int last = d() * (m() - 1);
    jacobian.template block<n, n>(last, last, d(), d()) -=
        isAdjoint_ ? end.derivativeOfTransposed(mu_) : end.derivativeOfRightTransposed(mu_ - W_);
}

/// The Jacobian at the present Y, and its factorisation.
template <class T, class G>
Outcome LieStep<T, G>::assembleJacobian() {
    if (isUnreduced_) placeFoot();
    fillJacobian();
    report_->cost.evaluations += nodes();
    ++report_->cost.linearSolves;
    // Inertias far apart make pivots far apart; only what is lost in round-off is singular.
    const Outcome factorised = lu_.factorise();
    if constexpr (isCoupled) {
        // A factor that is singular alone need not be so beside others.
        if (factorised == Outcome::singular && !isJoined_) {
            isJoined_ = true;
            lu_ = blocksOf(lagrangian_.couplings(), m(), true);
            fillJacobian();
            return lu_.factorise();
        }
    }
    return factorised;
}

/// Solves for the correction of Y from R, in flat_; returns its size relative to the unknowns.
template <class T, class G>
T LieStep<T, G>::correction() {
    for (int a = 0; a < m(); ++a) part(a) = -R_.col(a);
    lu_.solve(flat_.data());
    ++report_->cost.linearSolves;
    T size(0), scale(0);
    using std::abs;
    for (int a = 0; a < m(); ++a)
        for (int k = 0; k < d(); ++k) {
            const T change = abs(flat_(d() * a + k));
            if (!(change <= std::numeric_limits<T>::max())) return std::numeric_limits<T>::infinity();
            size = std::max(size, change);
            scale = std::max(scale, T(abs(Y_(k, a))));
        }
    return scale > T(0) ? T(size / scale) : size;
}

template <class T, class G>
void LieStep<T, G>::correct() {
    if constexpr (n != 6) {
        for (int a = 0; a < m(); ++a) Y_.col(a) += part(a);
    } else {
        points_.noalias() = Y_.lazyProduct(atPoints_.transpose());
        for (int k = 0; k < m(); ++k) {
            Vector change = Vector::Zero();
            for (int a = 0; a < m(); ++a) change += atPoints_(k, a) * part(a);
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
    if constexpr (hasIsotropy) inSpace_.setZero();
    placeFoot();
    if (lagrangian_.isFree()) return;
    for (int i = 0; i < nodes(); ++i) {
        auto&& at = chart<0>(xi_.col(i));
        const typename G::Element& g = group_.times(baseElement_, at);
        const Vector& f = lagrangian_.force(g, at, v_.col(i));
        const T weight = h_ * table_.weight(i);
        force_.col(i) = at.rotateMomentum(f);
        W_ -= weight * force_.col(i);
        if constexpr (hasIsotropy)
            if (group_.isOnSpheres()) group_.addInSpace(g, f, -weight, inSpace_);
    }
    report_->cost.evaluations += nodes();
}

/// Newton's method from the predicted curve. Light axes stop further away from round-off than others: with a
/// new Jacobian, the floor of the Lagrangian is what they can reach.
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
        const NewtonVerdict verdict =
            policy.judge(size, policy.isJacobianNew() ? lagrangian_.floor(Y_) : T(0));
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
Outcome LieStep<T, G>::advance(Pose& pose, StepReport& report, const std::stop_token& stop) {
    report_ = &report;
    known_ = base_ = pose;
    baseElement_ = group_.element(known_);
    mu_ = group_.bodyMomentum(baseElement_, known_);
    if (!predict()) return guess_.isRateFinite() ? Outcome::diverged : Outcome::notFinite;
    const Outcome solved = iterate(stop);
    if (solved != Outcome::converged) return solved;
    end_ = Y_.col(m() - 1);
    if (group_.isBeyond(end_)) return Outcome::diverged;
    if (isAdjoint_) {
        group_.fetch(base_, baseElement_, W_, known_);
        pose = base_;
    } else {
        pose = group_.place(base_, baseElement_, end_);
        group_.carry(base_, baseElement_, W_, pose);
    }
    if constexpr (hasIsotropy)
        if (group_.isOnSpheres()) pose.J = known_.J + T(isAdjoint_ ? 1 : -1) * inSpace_;
    return Outcome::converged;
}

template <class T, class G>
typename LieStep<T, G>::Pose LieStep<T, G>::denseOutput(const T& tau) const {
    const T s = isAdjoint_ ? T(1) - tau : tau;
    std::vector<T> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
    table_.space.evaluate(s, value, slope);
    const Flat phi = table_.change.transpose() * Eigen::Map<const Flat>(value.data(), table_.space.size);
    const Vector xi = Y_ * phi;
    Vector W = Vector::Zero(d());
    if (isUnreduced_) {
        const std::vector<T> share = weightsUpTo(table_, s);
        for (int i = 0; i < nodes(); ++i) W -= (h_ * share[static_cast<std::size_t>(i)]) * force_.col(i);
    }
    Pose at = group_.place(base_, baseElement_, xi);
    group_.carry(base_, baseElement_, W, at);
    return at;
}

}  // namespace extremal
