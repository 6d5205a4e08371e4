// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of VelocityIteration for any scalar. Included where GalerkinStep is instantiated.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/integrator/sweep/node_couplings_build.hpp"
#include "engine/integrator/sweep/velocity_iteration.hpp"
#include "engine/solve/fixed_point_policy.hpp"

namespace extremal {

template <class T>
bool VelocityIteration<T>::applies(const Mechanics<T>& mechanics, const Table<T>& table) {
    if (!mechanics.gradients || !mechanics.hessians || table.nodes() != table.unknowns()) return false;
    if (table.frequency != T(0) || table.weight.cwiseAbs().minCoeff() == T(0)) return false;
    // The rule integrates the slopes: sum_i b_i phi_a'(c_i) = phi_a(1).
    auto ends = (table.derivative.transpose() * table.weight).eval();
    ends(table.unknowns() - 1) -= T(1);
    return ends.cwiseAbs().maxCoeff() <= T(1e3) * std::numeric_limits<T>::epsilon();
}

template <class T>
VelocityIteration<T>::VelocityIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h,
                                        const T& tolerance, GradientsAndMasses withMasses)
    : mechanics_(mechanics),
      withMasses_(withMasses),
      d_(mechanics.dimension),
      n_(table.nodes()),
      stride_(inWholeLanes(n_)),
      tolerance_(tolerance),
      isExact_(tolerance <= std::numeric_limits<T>::epsilon()),
      couplings_(table),
      kernel_(velocityKernel<T>()) {
    const auto size = static_cast<std::size_t>(stride_), d = static_cast<std::size_t>(d_);
    for (Array* a : {&weight_, &times_, &curve_}) a->assign(size, T(0));
    for (Array* a : {&V_, &Q_, &P_, &drift_, &impulse_, &before_}) a->assign(size * d, T(0));
    gradient_.assign(2 * size * d, T(0));
    if (!withMasses) hessian_.assign(4 * size * d * d, T(0));
    inverse_.assign(size * d * d, T(0));
    size_.resize(d);
    setStep(h);
}

template <class T>
void VelocityIteration<T>::setStep(const T& step) {
    h_ = step;
    hasVelocities_ = false;
    for (int i = 0; i < n_; ++i) weight_[at(0, i)] = step * couplings_.b[at(0, i)];
}

/// Velocities of the step before, continued by the polynomial that the rule sees best, or the one at the
/// start. False where p_0 belongs to none.
template <class T>
bool VelocityIteration<T>::start(const T& t, const T* q, const T* p) {
    for (int i = 0; i < stride_; ++i) times_[at(0, i)] = t + couplings_.node[at(0, i)] * h_;
    if (!hasVelocities_) {
        Array& v = P_;  // not in use yet
        if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return false;
        for (int k = d_ - 1; k >= 0; --k)
            std::fill_n(V_.begin() + k * stride_, stride_, v[static_cast<std::size_t>(k)]);
        return true;
    }
    std::copy(V_.begin(), V_.end(), before_.begin());
    for (int k = 0; k < d_; ++k)
        kernel_.couple(couplings_.onward.data(), before_.data() + at(k, 0), n_, stride_,
                       V_.data() + at(k, 0));
    return true;
}

/// M at the nodes, where they are, by all second derivatives.
template <class T>
void VelocityIteration<T>::evaluateMasses() {
    mechanics_.hessians(mechanics_.model.get(), times_.data(), stride_, Q_.data(), V_.data(),
                        hessian_.data());
    for (int k = 0; k < d_; ++k)
        for (int l = 0; l < d_; ++l)
            std::copy_n(hessian_.data() + at((d_ + k) * 2 * d_ + d_ + l, 0), stride_,
                        inverse_.data() + at(k * d_ + l, 0));
}

/// The gradient where the nodes are.
template <class T>
void VelocityIteration<T>::evaluate(bool withMasses) {
    const void* const model = mechanics_.model.get();
    if (withMasses && withMasses_)
        withMasses_(model, times_.data(), stride_, Q_.data(), V_.data(), gradient_.data(), inverse_.data());
    else
        mechanics_.gradients(model, times_.data(), stride_, Q_.data(), V_.data(), gradient_.data());
}

/// The size of the last correction, apart from that of buried coordinates.
template <class T>
CorrectionSize<T> VelocityIteration<T>::measured(const T* q, const T* p) const {
    return measureCorrection<T>(d_, [&](int k) {
        const SweepSize<T>& size = size_[static_cast<std::size_t>(k)];
        return CoordinateCorrection<T>{size.change, size.scale, q[k], T(1) / inverse_[at(k * d_ + k, 0)],
                                       h_ * p[k]};
    });
}

template <class T>
Outcome VelocityIteration<T>::solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP,
                                    int maxIterations, const std::stop_token& stop, StepReport& report) {
    using Verdict = typename FixedPointPolicy<T>::Verdict;
    FixedPointPolicy<T> policy(tolerance_);
    const VelocitySweep<T> sweep{d_,
                                 n_,
                                 stride_,
                                 couplings_.mu.data(),
                                 couplings_.nu.data(),
                                 weight_.data(),
                                 q,
                                 p,
                                 carryQ,
                                 carryP,
                                 gradient_.data(),
                                 inverse_.data(),
                                 V_.data(),
                                 drift_.data(),
                                 impulse_.data(),
                                 Q_.data(),
                                 P_.data(),
                                 size_.data()};
    const bool isOnward = hasVelocities_;
    if (!start(t, q, p)) return Outcome::diverged;
    hasVelocities_ = false;
    kernel_.drift(sweep);
    if (!withMasses_) {
        evaluateMasses();
        report.cost.evaluations += n_;
    }
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        evaluate(iteration == 0);
        if (iteration == 0) kernel_.invert(sweep);
        kernel_.kick(sweep);
        kernel_.drift(sweep);
        ++report.cost.iterations;
        report.cost.evaluations += n_;
        T size(0);
        for (int k = 0; k < d_; ++k) {
            const SweepSize<T>& own = size_[static_cast<std::size_t>(k)];
            size = std::max(size, relativeCorrection(own.change, own.scale, q[k]));
        }
        if (iteration == 0) nearness_ = isOnward ? size : T(1);
        report.residual = static_cast<double>(size);
        const Verdict verdict = policy.judge(size, [&] { return measured(q, p); });
        if (verdict == Verdict::notFinite) return Outcome::notFinite;
        if (verdict == Verdict::slow) return Outcome::diverged;
        if (verdict == Verdict::proceed) continue;
        // Forces and velocities are taken where the last sweep has put the nodes: left where these were they
        // would have a bias that adds up over millions of steps.
        if (isExact_) {
            evaluate(false);
            kernel_.kick(sweep);
            for (int k = 0; k < d_; ++k)
                for (int i = 0; i < n_; ++i) drift_[at(k, i)] = weight_[at(0, i)] * V_[at(k, i)];
            report.cost.evaluations += n_;
        }
        hasVelocities_ = true;
        return Outcome::converged;
    }
    return Outcome::diverged;
}

template <class T>
void VelocityIteration<T>::increments(T* dq, T* dp, T* carryQ, T* carryP) const {
    for (int k = 0; k < d_; ++k) {
        couplings_.addUp(drift_.data() + at(k, 0), dq[k], carryQ[k]);
        couplings_.addUp(impulse_.data() + at(k, 0), dp[k], carryP[k]);
    }
}

/// Y / h of a coordinate.
template <class T>
const T* VelocityIteration<T>::curveOf(int k) const {
    kernel_.couple(couplings_.toY.data(), V_.data() + at(k, 0), n_, stride_, curve_.data());
    return curve_.data();
}

template <class T>
void VelocityIteration<T>::coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const {
    for (int k = 0; k < d_; ++k) {
        const T* const own = curveOf(k);
        for (int a = 0; a < n_; ++a) Y(a, k) = h_ * own[a];
        for (int i = 0; i < n_; ++i) forces(i, k) = gradient_[at(k, i)];
    }
}

template <class T>
void VelocityIteration<T>::curve(T* Y) const {
    for (int k = 0; k < d_; ++k) {
        const T* const own = curveOf(k);
        for (int a = 0; a < n_; ++a) Y[a * d_ + k] = h_ * own[a];
    }
}

template <class T>
void VelocityIteration<T>::remember(const Eigen::Ref<const Square>& velocities) {
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < stride_; ++i) V_[at(k, i)] = velocities(std::min(i, n_ - 1), k);
    hasVelocities_ = true;
}

}  // namespace extremal
