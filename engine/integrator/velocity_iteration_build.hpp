// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of VelocityIteration for any scalar. Included where GalerkinStep is instantiated.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/integrator/node_iteration_build.hpp"
#include "engine/integrator/velocity_iteration.hpp"

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
                                        const T& tolerance)
    : mechanics_(mechanics),
      d_(mechanics.dimension),
      n_(table.nodes()),
      stride_(inWholeLanes(n_)),
      tolerance_(tolerance),
      isExact_(tolerance <= std::numeric_limits<T>::epsilon()),
      toY_(dense::inverse<T>(table.derivative)) {
    const auto size = static_cast<std::size_t>(stride_), d = static_cast<std::size_t>(d_);
    for (Array* a : {&node_, &b_, &weight_, &times_, &change_}) a->assign(size, T(0));
    for (Array* a : {&mu_, &nu_, &onward_}) a->assign(size * size, T(0));
    for (Array* a : {&carryQ_, &carryP_, &V_, &Q_, &P_, &moved_, &kicked_, &drift_, &impulse_, &before_})
        a->assign(size * d, T(0));
    gradient_.assign(2 * size * d, T(0));
    hessian_.assign(4 * size * d * d, T(0));
    inverse_.assign(size * d * d, T(0));
    ones_.assign(d, T(1));
    size_.resize(d);
    const Square A = table.value * toY_, onward = detail::extrapolation<T>(table.rule);
    Square mu = A;
    for (int j = 0; j < n_; ++j) mu.col(j) /= table.weight(j);
    const detail::Grid<T> round(T(1) + mu.cwiseAbs().maxCoeff());
    for (int i = 0; i < stride_; ++i) {
        const int node = std::min(i, n_ - 1);  // the lanes beyond the last node repeat it
        node_[at(0, i)] = table.node(node);
        if (i < n_) b_[at(0, i)] = table.weight(i);
        for (int j = 0; j < n_; ++j) {
            mu_[at(j, i)] = round(mu(node, j));
            nu_[at(j, i)] = T(1) - round(mu(j, node));
            onward_[at(j, i)] = onward(j, node);
        }
    }
    setStep(h);
    if constexpr (std::is_same_v<T, double>)
        sweep_ = nodeParallelSweep();
    else
        sweep_ = &sweep<T>;
}

template <class T>
void VelocityIteration<T>::setStep(const T& step) {
    h_ = step;
    hasVelocities_ = false;
    for (int i = 0; i < n_; ++i) weight_[at(0, i)] = step * b_[at(0, i)];
}

/// Velocities of the step before, continued by the polynomial that the rule sees best, or the one at the
/// start. False where p_0 belongs to none.
template <class T>
bool VelocityIteration<T>::start(const T& t, const T* q, const T* p) {
    for (int i = 0; i < stride_; ++i) times_[at(0, i)] = t + node_[at(0, i)] * h_;
    if (!hasVelocities_) {
        Array& v = P_;  // not in use yet
        if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return false;
        for (int k = d_ - 1; k >= 0; --k)
            std::fill_n(V_.begin() + k * stride_, stride_, v[static_cast<std::size_t>(k)]);
        return true;
    }
    before_.swap(V_);
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < stride_; ++i) {
            T sum(0);
            for (int j = 0; j < n_; ++j) sum += onward_[at(j, i)] * before_[at(k, j)];
            V_[at(k, i)] = sum;
        }
    return true;
}

/// M^-1 at the nodes, where they are: Gauss and Jordan in place, without pivots, as it need not be exact.
template <class T>
void VelocityIteration<T>::invertMasses() {
    mechanics_.hessians(mechanics_.model.get(), times_.data(), stride_, Q_.data(), V_.data(),
                        hessian_.data());
    const auto entry = [&](int k, int l) { return inverse_.data() + at(k * d_ + l, 0); };
    for (int k = 0; k < d_; ++k)
        for (int l = 0; l < d_; ++l)
            std::copy_n(hessian_.data() + at((d_ + k) * 2 * d_ + d_ + l, 0), stride_, entry(k, l));
    for (int k = 0; k < d_; ++k) {
        T* const pivot = entry(k, k);
        for (int i = 0; i < stride_; ++i) pivot[i] = T(1) / pivot[i];
        for (int l = 0; l < d_; ++l) {
            if (l == k) continue;
            T* const own = entry(k, l);
            for (int i = 0; i < stride_; ++i) own[i] *= pivot[i];
        }
        for (int r = 0; r < d_; ++r) {
            if (r == k) continue;
            T* const factor = entry(r, k);
            for (int l = 0; l < d_; ++l) {
                if (l == k) continue;
                T* const changed = entry(r, l);
                const T* const own = entry(k, l);
                for (int i = 0; i < stride_; ++i) changed[i] -= factor[i] * own[i];
            }
            for (int i = 0; i < stride_; ++i) factor[i] *= -pivot[i];
        }
    }
}

/// The gradient where the nodes are, the momenta that its forces give, and v + M^-1 (p - L_v), with the size
/// of that correction, sum_i w_i |dv_i|: places alone would not tell, as those of a rule's left end never
/// move.
template <class T>
void VelocityIteration<T>::kick(const T* p) {
    using std::abs;
    mechanics_.gradients(mechanics_.model.get(), times_.data(), stride_, Q_.data(), V_.data(),
                         gradient_.data());
    sweep_({d_, n_, stride_, nu_.data(), carryP_.data(), gradient_.data(), weight_.data(), impulse_.data(),
            ones_.data(), p, kicked_.data(), P_.data()});
    const T* const Lv = gradient_.data() + at(d_, 0);
    for (std::size_t i = 0; i < P_.size(); ++i) P_[i] -= Lv[i];
    for (int k = 0; k < d_; ++k) {
        T* const change = change_.data();
        std::fill(change_.begin(), change_.end(), T(0));
        for (int l = 0; l < d_; ++l) {
            const T* const inverse = inverse_.data() + at(k * d_ + l, 0);
            for (int i = 0; i < stride_; ++i) change[i] += inverse[i] * P_[at(l, i)];
        }
        SweepSize<T>& size = size_[static_cast<std::size_t>(k)];
        size = {};
        for (int i = 0; i < stride_; ++i) {
            V_[at(k, i)] += change[i];
            size.change += abs(T(weight_[at(0, i)] * change[i]));
            size.scale += abs(T(weight_[at(0, i)] * V_[at(k, i)]));
        }
    }
}

/// The places that the velocities give.
template <class T>
void VelocityIteration<T>::drift(const T* q) {
    sweep_({d_, n_, stride_, mu_.data(), carryQ_.data(), V_.data(), weight_.data(), drift_.data(),
            ones_.data(), q, moved_.data(), Q_.data()});
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
    for (int k = 0; k < d_; ++k) {
        std::fill_n(carryQ_.begin() + k * stride_, stride_, carryQ[k]);
        std::fill_n(carryP_.begin() + k * stride_, stride_, carryP[k]);
    }
    const bool isOnward = hasVelocities_;
    if (!start(t, q, p)) return Outcome::diverged;
    hasVelocities_ = false;
    drift(q);
    invertMasses();
    report.cost.evaluations += n_;
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        kick(p);
        drift(q);
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
            kick(p);
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
    using Accumulator = std::conditional_t<std::is_same_v<T, double>, long double, T>;
    const auto add = [&](const Array& parts, int k, T& main, T& carry) {
        Accumulator sums[2] = {Accumulator(0), Accumulator(0)};  // two, as each waits for its last sum
        for (int i = 0; i < stride_; i += 2)                     // beyond the nodes parts are 0
            for (int l = 0; l < 2; ++l) sums[l] += Accumulator(parts[at(k, i + l)]);
        const Accumulator sum = sums[0] + sums[1];
        main = static_cast<T>(sum);
        carry += static_cast<T>(sum - Accumulator(main));
    };
    for (int k = 0; k < d_; ++k) {
        add(drift_, k, dq[k], carryQ[k]);
        add(impulse_, k, dp[k], carryP[k]);
    }
}

template <class T>
void VelocityIteration<T>::coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const {
    for (int k = 0; k < d_; ++k) {
        for (int a = 0; a < n_; ++a) {
            T sum(0);
            for (int i = 0; i < n_; ++i) sum += toY_(a, i) * V_[at(k, i)];
            Y(a, k) = h_ * sum;
        }
        for (int i = 0; i < n_; ++i) forces(i, k) = gradient_[at(k, i)];
    }
}

template <class T>
void VelocityIteration<T>::remember(const Eigen::Ref<const Square>& velocities) {
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < stride_; ++i) V_[at(k, i)] = velocities(std::min(i, n_ - 1), k);
    hasVelocities_ = true;
}

}  // namespace extremal
