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
                       const T& base, SolverPolicy policy)
    : group_(mechanics),
      table_(std::move(table)),
      h_(step),
      nu_(base),
      hasBegin_(base != T(0)),
      hasEnd_(base != T(1)),
      policy_(policy),
      tolerance_(toleranceOf<T>(policy)),
      lagrangian_(mechanics),
      guess_(group_, mechanics),
      charts_(chartsOf<G>(group_)) {
    isUnreduced_ = !lagrangian_.isFree() || (Lagrangian::hasSpaceForm && !isReduced);
    for (Columns* c : {&Y_, &R_, &points_}) *c = Columns::Zero(d(), m());
    for (Columns* c : {&xi_, &v_, &force_}) *c = Columns::Zero(d(), nodes());
    W_ = mu_ = muBase_ = forXi_ = forV_ = begin_ = end_ = Vector::Zero(d());
    if constexpr (hasIsotropy) inSpace_ = W_;
    const int size = d() * m();
    if constexpr (isCoupled)
        lu_ = blocksOf(lagrangian_.couplings(), m(), false);
    else
        lu_ = SmallLu<T>(size);
    flat_ = Flat::Zero(size);
    const auto functionsAt = [&](const T& tau) {
        std::vector<T> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
        table_.space.evaluate(tau, value, slope);
        const Flat phi = table_.change.transpose() * Eigen::Map<const Flat>(value.data(), table_.space.size);
        return std::vector<T>(phi.begin(), phi.end());
    };
    // At the ends they are 0, but for the last at the end: to the last bit.
    atBase_.assign(static_cast<std::size_t>(m()), T(0));
    atEnd_ = atBase_;
    atEnd_.back() = T(1);
    if (!hasEnd_)
        atBase_ = atEnd_;
    else if (hasBegin_)
        atBase_ = functionsAt(nu_);
    for (std::size_t a = 0; a < atBase_.size(); ++a) {
        atBegin_.push_back(-atBase_[a]);
        atEnd_[a] -= atBase_[a];
        table_.value.col(static_cast<Eigen::Index>(a)).array() -= atBase_[a];
    }
    // Y from the values of xi at m points, and back: at the base point it is 0 whatever Y is.
    times_ = lobatto<T>(m() + 1).c;
    using std::abs;
    times_.erase(std::min_element(times_.begin(), times_.end(), [this](const T& one, const T& other) {
        return abs(one - nu_) < abs(other - nu_);
    }));
    atPoints_ = Square(m(), m());
    for (int k = 0; k < m(); ++k) {
        const std::vector<T> phi = functionsAt(valueOf(times_, k));
        for (int a = 0; a < m(); ++a) atPoints_(k, a) = valueOf(phi, a) - valueOf(atBase_, a);
    }
    fit_ = dense::inverse<T>(atPoints_);
}

/// xi_i, xi'_i and xi at the ends from Y.
template <class T, class G>
void LieStep<T, G>::placeNodes() {
    xi_.noalias() = Y_.lazyProduct(table_.value.transpose());
    v_.noalias() = Y_.lazyProduct(table_.derivative.transpose());
    v_ /= h_;
    begin_.setZero();
    end_.setZero();
    for (int a = 0; a < m(); ++a) {
        if (hasBegin_) begin_ += valueOf(atBegin_, a) * Y_.col(a);
        if (valueOf(atEnd_, a) != T(0)) end_ += valueOf(atEnd_, a) * Y_.col(a);
    }
}

/// The base point follows from the unknowns where it is not the start.
template <class T, class G>
void LieStep<T, G>::placeBase() {
    if (!hasBegin_) return;
    forXi_ = -begin_;
    base_ = group_.place(known_, knownElement_, forXi_);
    baseElement_ = group_.element(base_);
}

/// Y of the curve through guessed poses at the m points; false where the step is so long that there is none.
template <class T, class G>
bool LieStep<T, G>::predict() {
    guess_.curve(known_, mu_, times_, nu_, h_, points_);
    Y_.noalias() = points_.lazyProduct(fit_.transpose());
    using std::isfinite;
    return isfinite(Y_.squaredNorm());
}

/// R, the equations at the present Y: dL_d/dY by the chain rule, less the momenta at the ends of the chart.
/// Fills force_ (as momenta at the base point), W and mu_b.
template <class T, class G>
void LieStep<T, G>::residual() {
    R_.setZero();
    W_.setZero();
    if (isUnreduced_) placeBase();
    if (hasBegin_) {
        auto&& start = chart<0>(begin_);
        muBase_ = start.rotateMomentum(mu_);
        forXi_ = start.dexpTransposed(mu_);
        for (int a = 0; a < m(); ++a) R_.col(a) += valueOf(atBegin_, a) * forXi_;
    }
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
    if (hasEnd_) {
        auto&& end = chart<0>(end_);
        forXi_ = end.dexpRightTransposed(muBase_ - W_);
        for (int a = 0; a < m(); ++a)
            if (valueOf(atEnd_, a) != T(0)) R_.col(a) -= valueOf(atEnd_, a) * forXi_;
    }
    if constexpr (hasIsotropy)
        for (const int k : group_.isotropy()) R_.row(k) = Y_.row(k);
    // Of the attitude, a free body has a force to evaluate besides.
    report_->cost.evaluations += (isUnreduced_ && lagrangian_.isFree() ? 2 : 1) * nodes();
}

/// Adds what the force at node i does to the equations through the base point, which moves by `toBase` with
/// xi_0, and through W.
template <class T, class G>
void LieStep<T, G>::addForceAt(int i, const typename G::template Chart<2>& at,
                               const typename Lagrangian::ForceSlope& F,
                               const Matrix& toBase) requires(!isCoupled) {
    auto jacobian = this->jacobian();
    Matrix byBase = Matrix::Zero(), byXi = byBase;
    if (hasBegin_) {
        for (int k = 0; k < d(); ++k) byBase.col(k) = at.rotateBack(toBase.col(k));
        byBase = (F.S() * byBase).eval();
        const Matrix onXi = F.A().transpose() * byBase;
        for (int c = 0; c < m(); ++c)
            addGradient(m(), testAt(i), Matrix(valueOf(atBegin_, c) * onXi), Matrix(Matrix::Zero()),
                        [&](int a) { return jacobian.template block<n, n>(d() * a, d() * c, d(), d()); });
    }
    if (!hasEnd_) return;
    // dexp(-xi_1)^T dW, with what xi does to the force.
    byXi = (F.S() - group_.precessionMatrix(F.f())) * F.A();
    const auto end = group_.template chart<0>(end_);
    for (Matrix* const by : {&byXi, &byBase})
        for (int k = 0; k < d(); ++k)
            by->col(k) = end.dexpRightTransposed(at.rotateMomentum(by->col(k))).eval();
    const T weight = table_.weight(i) * h_;
    for (int a = 0; a < m(); ++a)
        for (int c = 0; c < m() && valueOf(atEnd_, a) != T(0); ++c) {
            Matrix by = table_.value(i, c) * byXi;
            if (hasBegin_) by += valueOf(atBegin_, c) * byBase;
            jacobian.template block<n, n>(d() * a, d() * c, d(), d()) -= (valueOf(atEnd_, a) * weight) * by;
        }
}

/// dR/dY at the present Y.
template <class T, class G>
void LieStep<T, G>::fillJacobian() requires(!isCoupled) {
    auto jacobian = this->jacobian();
    const auto block = [&](int a, int c) {
        return jacobian.template block<n, n>(d() * a, d() * c, d(), d());
    };
    jacobian.setZero();
    Matrix toBase = Matrix::Zero();
    if (hasBegin_) toBase = -chartToBase().dexpMatrix();
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<2> at = group_.template chart<2>(xi_.col(i));
        typename Lagrangian::Second L;
        if (lagrangian_.isFree()) {
            L = lagrangian_.second(at, v_.col(i));
        } else {
            typename Lagrangian::ForceSlope F;
            L = lagrangian_.second(group_.times(baseElement_, at), at, v_.col(i), F);
            addForceAt(i, at, F, toBase);
        }
        const Matrix xiV = L.vXi.transpose();
        addHessian(m(), m(), testAt(i), trialAt(i), L.xiXi, xiV, L.vXi, L.vv, block);
    }
    if (hasBegin_) {
        const auto start = group_.template chart<1>(begin_);
        const Matrix by = start.derivativeOfTransposed(mu_);
        forFunctions(atBegin_, atBegin_, [&](int a, int c, const T& both) { block(a, c) += both * by; });
    }
    if (!hasEnd_) return;
    const auto end = group_.template chart<1>(end_);
    const Matrix by = end.derivativeOfRightTransposed(muBase_ - W_);
    forFunctions(atEnd_, atEnd_, [&](int a, int c, const T& both) { block(a, c) -= both * by; });
    if (!hasBegin_) return;
    Matrix byBase = group_.precessionMatrix(muBase_) * toBase;
    for (int k = 0; k < d(); ++k) byBase.col(k) = end.dexpRightTransposed(byBase.col(k)).eval();
    forFunctions(atEnd_, atBegin_, [&](int a, int c, const T& both) { block(a, c) -= both * byBase; });
}

/// The Jacobian at the present Y, and its factorisation.
template <class T, class G>
Outcome LieStep<T, G>::assembleJacobian() {
    if (isUnreduced_) placeBase();
    if (hasBegin_) muBase_ = chart<0>(begin_).rotateMomentum(mu_);
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
    placeBase();
    if (hasBegin_) group_.carry(known_, knownElement_, W_, base_);
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
    baseElement_ = knownElement_ = group_.element(known_);
    mu_ = muBase_ = group_.bodyMomentum(knownElement_, known_);
    if (!predict()) return guess_.isRateFinite() ? Outcome::diverged : Outcome::notFinite;
    const Outcome solved = iterate(stop);
    if (solved != Outcome::converged) return solved;
    if (group_.isBeyond(end_) || group_.isBeyond(begin_)) return Outcome::diverged;
    if (hasEnd_)
        pose = group_.place(base_, baseElement_, end_);
    else
        pose = base_;
    group_.carry(base_, baseElement_, W_, pose);
    if constexpr (hasIsotropy)
        if (group_.isOnSpheres()) pose.J = known_.J - inSpace_;
    return Outcome::converged;
}

template <class T, class G>
typename LieStep<T, G>::Pose LieStep<T, G>::denseOutput(const T& tau) const {
    std::vector<T> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
    table_.space.evaluate(tau, value, slope);
    const Flat psi = table_.change.transpose() * Eigen::Map<const Flat>(value.data(), table_.space.size) -
                     Eigen::Map<const Flat>(atBase_.data(), m());
    const Vector xi = Y_ * psi;
    Vector W = Vector::Zero(d());
    if (isUnreduced_) {
        const std::vector<T> share = weightsUpTo(table_, tau);
        for (int i = 0; i < nodes(); ++i) W -= (h_ * share[static_cast<std::size_t>(i)]) * force_.col(i);
    }
    Pose at = group_.place(base_, baseElement_, xi);
    group_.carry(base_, baseElement_, W, at);
    return at;
}

}  // namespace extremal
