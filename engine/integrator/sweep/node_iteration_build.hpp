// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of NodeIteration for any scalar. Included where GalerkinStep is instantiated.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/work.hpp"
#include "engine/integrator/sweep/node_iteration.hpp"
#include "engine/solve/fixed_point_policy.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace detail {

/// (j, i): weight of the force at node j in its extrapolation to 1 + c_i, by the polynomial of the highest
/// degree whose Legendre coefficients the rule integrates exactly.
template <class T>
typename NodeIteration<T>::Square extrapolation(const Rule<T>& rule) {
    const int n = rule.size(), degree = std::min(n - 1, rule.degree / 2);
    typename NodeIteration<T>::Square here(n, degree + 1), beyond(n, degree + 1);
    for (int i = 0; i < n; ++i) {
        const auto fill = [&](auto row, const T& c) {
            const T x = 2 * c - 1;
            row(0) = T(1);
            if (degree > 0) row(1) = x;
            for (int k = 1; k < degree; ++k)
                row(k + 1) = (T(2 * k + 1) * x * row(k) - T(k) * row(k - 1)) / T(k + 1);
        };
        fill(here.row(i), rule.c[static_cast<std::size_t>(i)]);
        fill(beyond.row(i), T(1) + rule.c[static_cast<std::size_t>(i)]);
    }
    for (int j = 0; j < n; ++j)
        for (int k = 0; k <= degree; ++k) here(j, k) *= rule.b[static_cast<std::size_t>(j)] * T(2 * k + 1);
    return here * beyond.transpose();
}

/// Rounds to multiples of one unit, of which the numbers below `largest` in magnitude are at most 1/epsilon.
template <class T>
class Grid {
public:
    explicit Grid(const T& largest) {
        T above(1);
        while (above <= largest && above < std::numeric_limits<T>::max() / 2) above *= 2;
        while (above / 2 > largest) above /= 2;
        unit_ = above * std::numeric_limits<T>::epsilon() / 2;
    }
    T operator()(const T& x) const {
        using std::round;
        return round(T(x / unit_)) * unit_;
    }

private:
    T unit_;
};

}  // namespace detail

template <class T>
NodeIteration<T>::NodeIteration(const Mechanics<T>& mechanics, const Table<T>& table, const T& h,
                                const T& tolerance)
    : mechanics_(mechanics),
      d_(mechanics.dimension),
      n_(table.nodes()),
      m_(table.unknowns()),
      stride_(inWholeLanes(n_)),
      h_(h),
      tolerance_(tolerance),
      isExact_(tolerance <= std::numeric_limits<T>::epsilon()) {
    work::spend(static_cast<double>(n_) * n_ * (3 * m_ + 64));
    const Square kinetic =
        table.testDerivative.transpose() * table.weight.asDiagonal() * table.derivative / h;
    const Square inverse = dense::inverse<T>(kinetic);
    const Square moments = h * (table.testValue.transpose() * table.weight.asDiagonal());  // m x n
    const Square toForces = -inverse * moments;                                            // m x n
    const Square G = table.value * toForces;
    made_.step = h;
    made_.start = G * detail::extrapolation<T>(table.rule).transpose();
    made_.toForces = toForces;
    made_.N = G;
    for (int j = 0; j < n_; ++j)
        made_.N.col(j) *= table.weight(j) != T(0) ? T(1 / (h * table.weight(j))) : T(0);
    made_.times = -table.value * inverse.col(m_ - 1);
    made_.velocities = -inverse.col(m_ - 1);
    made_.weight = table.weight;

    const auto size = static_cast<std::size_t>(stride_), d = static_cast<std::size_t>(d_);
    const auto unknowns = static_cast<std::size_t>(m_);
    for (Array* a : {&node_, &weight_, &toEnd_, &slope_, &times_}) a->assign(size, T(0));
    for (Array* a : {&N_, &start_}) a->assign(size * size, T(0));
    for (Array* a : {&base_, &F_, &impulse_, &Z_, &Q_}) a->assign(size * d, T(0));
    for (Array* a : {&inverseMass_, &v0_, &lost_, &place_, &force_, &end_.place, &end_.force})
        a->assign(d, T(0));
    toForces_.assign(size * unknowns, T(0));
    toVelocity_.assign(unknowns, T(0));
    size_.resize(d);
    for (int i = 0; i < stride_; ++i)
        node_[at(0, i)] = table.node(std::min(i, n_ - 1));  // the lanes beyond the last node repeat it
    setStep(h);
    for (int k = 0; k < d_; ++k) inverseMass_[static_cast<std::size_t>(k)] = 1 / mechanics.masses[k];
    if constexpr (std::is_same_v<T, double>)
        sweep_ = nodeParallelSweep();
    else
        sweep_ = &sweep<T>;
}

/// Scales the tables as they were made: N and s by h, what is by forces in place of impulses by h^2.
template <class T>
void NodeIteration<T>::setStep(const T& step) {
    const T ratio = step / made_.step, square = ratio * ratio;
    h_ = step;
    hasForces_ = false;
    for (int a = 0; a < m_; ++a) {
        toVelocity_[static_cast<std::size_t>(a)] = made_.velocities(a) * ratio;
        for (int i = 0; i < n_; ++i) toForces_[at(a, i)] = made_.toForces(a, i) * square;
    }
    // The space has the linear functions, but for rounding.
    using std::abs;
    const T roundOff = 16 * std::numeric_limits<T>::epsilon() * abs(step);
    const auto orLinear = [&](const T& time, const T& c) {
        return abs(T(time - step * c)) <= roundOff ? T(step * c) : time;
    };
    const T end = orLinear(T(made_.velocities(m_ - 1) * ratio), T(1));
    T largest = abs(end);
    for (int i = 0; i < n_; ++i) {
        slope_[at(0, i)] = orLinear(T(made_.times(i) * ratio), node_[at(0, i)]);
        largest = std::max(largest, T(abs(slope_[at(0, i)])));
        for (int j = 0; j < n_; ++j) largest = std::max(largest, T(abs(T(made_.N(i, j) * ratio))));
    }
    // From here on multiples of one unit: differences are exact, and so is the condition N_ij - N_ji = s_i -
    // s_j.
    const detail::Grid<T> round(largest);
    velocityToEnd_ = round(end);
    for (int i = 0; i < stride_; ++i) {
        slope_[at(0, i)] = i < n_ ? round(slope_[at(0, i)]) : slope_[at(0, n_ - 1)];
        toEnd_[at(0, i)] = velocityToEnd_ - slope_[at(0, i)];
        if (i < n_) weight_[at(0, i)] = step * made_.weight(i);
    }
    // Round-off in the place of a zero would have an explicit step iterate: a node sees another, or not.
    const T unseen = 4 * std::numeric_limits<T>::epsilon() * abs(velocityToEnd_);
    const auto N = [&](int i, int j) {  // i >= j
        const T seen = round(T(made_.N(i, j) * ratio)), between = slope_[at(0, i)] - slope_[at(0, j)];
        return abs(seen) <= unseen ? T(0) : abs(T(seen - between)) <= unseen ? between : seen;
    };
    for (int j = 0; j < n_; ++j)
        for (int i = 0; i < stride_; ++i) {
            const int node = std::min(i, n_ - 1);
            start_[at(j, i)] = made_.start(node, j) * square;
            N_[at(j, i)] = node >= j ? N(node, j) : N(j, node) + (slope_[at(0, node)] - slope_[at(0, j)]);
        }
    findSources();
}

template <class T>
void NodeIteration<T>::findSources() {
    const auto sees = [&](int i, int j) { return N_[at(j, i)] != T(0); };
    sources_ = 0;
    for (int i = 0; i < n_ && sources_ == i; ++i) {
        bool seesNone = true;
        for (int j = 0; j < n_; ++j) seesNone = seesNone && !sees(i, j);
        sources_ += seesNone ? 1 : 0;
    }
    for (int i = sources_; i < n_; ++i)
        for (int j = sources_; j < n_; ++j)
            if (sees(i, j)) sources_ = 0;
    endsAtNode_ = sources_ > 0 && node_[at(0, n_ - 1)] == T(1);
    for (int i = sources_; i < n_; ++i) endsAtNode_ = endsAtNode_ && toEnd_[at(0, i)] == T(0);
}

/// Times of the nodes, and where they would be without a force.
template <class T>
void NodeIteration<T>::place(const T& t, const T* p, const T* carryQ, const T* carryP) {
    for (int i = 0; i < stride_; ++i) times_[at(0, i)] = t + node_[at(0, i)] * h_;
    for (int k = 0; k < d_; ++k) {
        const auto c = static_cast<std::size_t>(k);
        v0_[c] = p[k] * inverseMass_[c];
        lost_[c] = carryP[k] * inverseMass_[c];  // far below v_0, whose round-off would swallow it
        for (int i = 0; i < stride_; ++i)
            base_[at(k, i)] = slope_[at(0, i)] * v0_[c] + (slope_[at(0, i)] * lost_[c] + carryQ[k]);
    }
}

template <class T>
void NodeIteration<T>::evaluateForces() {
    const void* model = mechanics_.model.get();
    if (mechanics_.forces)
        mechanics_.forces(model, times_.data(), stride_, Q_.data(), F_.data());
    else
        evaluateOneByOne(0, n_);
}

template <class T>
void NodeIteration<T>::weigh() {
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < stride_; ++i) impulse_[at(k, i)] = weight_[at(0, i)] * F_[at(k, i)];
}

template <class T>
void NodeIteration<T>::evaluateOneByOne(int first, int last) {
    for (int i = first; i < last; ++i) {
        for (int k = 0; k < d_; ++k) place_[static_cast<std::size_t>(k)] = Q_[at(k, i)];
        mechanics_.force(mechanics_.model.get(), times_[at(0, i)], place_.data(), force_.data());
        for (int k = 0; k < d_; ++k) F_[at(k, i)] = force_[static_cast<std::size_t>(k)];
    }
}

template <class T>
void NodeIteration<T>::startFromConstantForce(const T& t, const T* q) {
    mechanics_.force(mechanics_.model.get(), t, q, force_.data());
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < n_; ++i) F_[at(k, i)] = force_[static_cast<std::size_t>(k)];
}

/// Size of the last sweep's change.
template <class T>
T NodeIteration<T>::largestChange(const T* q) const {
    T worst(0);
    for (int k = 0; k < d_; ++k) {
        const SweepSize<T>& size = size_[static_cast<std::size_t>(k)];
        worst = std::max(worst, relativeCorrection(size.change, size.scale, q[k]));
    }
    return worst;
}

/// The same apart from that of buried coordinates.
template <class T>
CorrectionSize<T> NodeIteration<T>::measured(const T* q, const T* p) const {
    return measureCorrection<T>(d_, [&](int k) {
        const SweepSize<T>& size = size_[static_cast<std::size_t>(k)];
        return CoordinateCorrection<T>{size.change, size.scale, q[k], mechanics_.masses[k], h_ * p[k]};
    });
}

template <class T>
Outcome NodeIteration<T>::solve(const T& t, const T* q, const T* p, const T* carryQ, const T* carryP,
                                int maxIterations, const std::stop_token& stop, StepReport& report) {
    using Verdict = typename FixedPointPolicy<T>::Verdict;
    place(t, p, carryQ, carryP);
    if (sources_ > 0 && solveExplicitly(t, q, carryQ, report)) return Outcome::converged;
    FixedPointPolicy<T> policy(tolerance_);
    Sweep<T> s{d_,        n_,        stride_,         start_.data(),       base_.data(),
               F_.data(), nullptr,   impulse_.data(), inverseMass_.data(), q,
               Z_.data(), Q_.data(), size_.data()};
    const auto useImpulses = [&] {  // from here on; the extrapolation of the last step is in terms of forces
        s.G = N_.data();
        s.weight = weight_.data();
    };
    const bool isOnward = hasForces_;
    if (!hasForces_) {
        startFromConstantForce(t, q);
        ++report.cost.evaluations;
        useImpulses();
    }
    sweep_(s);
    useImpulses();
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        evaluateForces();
        sweep_(s);
        ++report.cost.iterations;
        report.cost.evaluations += n_;
        const T size = largestChange(q);
        if (iteration == 0) nearness_ = isOnward ? size : T(1);
        report.residual = static_cast<double>(size);
        hasForces_ = false;
        const Verdict verdict = policy.judge(size, [&] { return measured(q, p); });
        if (verdict == Verdict::notFinite) return Outcome::notFinite;
        if (verdict == Verdict::slow) return Outcome::diverged;
        if (verdict == Verdict::proceed) continue;
        // The forces are taken where the last sweep has put the nodes: left where the nodes were they would
        // have a bias that adds up over millions of steps.
        if (isExact_) {
            evaluateForces();
            weigh();
            report.cost.evaluations += n_;
        }
        hasForces_ = true;
        return Outcome::converged;
    }
    return Outcome::diverged;
}

/// Whether the first node, the only one that sees no other, is where the last node of the step before was.
template <class T>
bool NodeIteration<T>::beginsAtEnd(const T& t, const T* q) const {
    if (!end_.isKnown || sources_ != 1 || node_[at(0, 0)] != T(0)) return false;
    if (mechanics_.isTimeDependent && end_.t != t) return false;
    for (int k = 0; k < d_; ++k)
        if (q[k] + base_[at(k, 0)] != end_.place[static_cast<std::size_t>(k)]) return false;
    return true;
}

/// The fixed point without an iteration: the nodes that see no other, and then the others. So few forces are
/// evaluated one by one. False where rounding moves a node after all, or a force is not finite: the iteration
/// says what becomes of that.
template <class T>
bool NodeIteration<T>::solveExplicitly(const T& t, const T* q, const T* carryQ, StepReport& report) {
    using std::abs;
    const bool isOnward = std::exchange(hasForces_, false), isShared = beginsAtEnd(t, q);
    const auto moved = [&](const Array& by, const Array& forces, int nodes, int k, int i) {
        T sum(0);
        for (int j = 0; j < nodes; ++j) sum += by[at(j, i)] * forces[at(k, j)];
        return base_[at(k, i)] + sum * inverseMass_[static_cast<std::size_t>(k)];
    };
    if (isOnward)  // where the nodes are expected, to tell how near that was
        for (int k = 0; k < d_; ++k)
            for (int i = 0; i < n_; ++i) Z_[at(k, i)] = moved(start_, F_, n_, k, i);
    const auto solveNodes = [&](int first, int last, bool isKnown) {
        for (int k = 0; k < d_; ++k)
            for (int i = first; i < last; ++i) Q_[at(k, i)] = q[k] + moved(N_, impulse_, first, k, i);
        // Rounded as the end of the step will be, so that the next one begins there to the last bit.
        if (endsAtNode_ && last == n_)
            for (int k = 0; k < d_; ++k) {
                T carry = carryQ[k];
                const T increment = split(displacement(k), carry);
                Q_[at(k, n_ - 1)] = q[k] + (increment + carry);
            }
        if (isKnown) {
            for (int k = 0; k < d_; ++k) F_[at(k, 0)] = end_.force[static_cast<std::size_t>(k)];
        } else {
            evaluateOneByOne(first, last);
            report.cost.evaluations += last - first;
        }
        for (int k = 0; k < d_; ++k)
            for (int i = first; i < last; ++i) impulse_[at(k, i)] = weight_[at(0, i)] * F_[at(k, i)];
    };
    solveNodes(0, sources_, isShared);
    solveNodes(sources_, n_, false);
    const T roundOff = 4 * std::numeric_limits<T>::epsilon();
    bool isThere = true;
    for (int k = 0; k < d_; ++k) {
        T change(0), scale(0);
        for (int i = 0; i < n_; ++i) {
            const T z = moved(N_, impulse_, n_, k, i);
            const T place = Q_[at(k, i)];
            isThere = isThere && (endsAtNode_ && i == n_ - 1
                                      ? abs(T(q[k] + z - place)) <= roundOff * (abs(q[k]) + abs(z))
                                      : q[k] + z == place);
            change = std::max(change, T(abs(z - Z_[at(k, i)])));
            scale = std::max(scale, T(abs(z)));
            Z_[at(k, i)] = z;
        }
        size_[static_cast<std::size_t>(k)] = {change, scale};
    }
    nearness_ = isOnward ? largestChange(q) : T(1);
    report.residual = 0;
    hasForces_ = end_.isKnown = isThere;
    if (!isThere) return false;
    end_.t = times_[at(0, n_ - 1)];
    for (int k = 0; k < d_; ++k) {
        end_.place[static_cast<std::size_t>(k)] = Q_[at(k, n_ - 1)];
        end_.force[static_cast<std::size_t>(k)] = F_[at(k, n_ - 1)];
    }
    return true;
}

template <class T>
void NodeIteration<T>::increments(T* dq, T* dp, T* carryQ, T* carryP) const {
    for (int k = 0; k < d_; ++k) {
        Accumulator impulses[2] = {Accumulator(0), Accumulator(0)};  // two, as each waits for its last sum
        for (int i = 0; i < n_; i += 2)                              // beyond the nodes impulses are 0
            for (int l = 0; l < 2; ++l) impulses[l] += Accumulator(impulse_[at(k, i + l)]);
        dq[k] = split(displacement(k), carryQ[k]);
        dp[k] = split(impulses[0] + impulses[1], carryP[k]);
    }
}

/// q_1 - q_0 of a coordinate.
template <class T>
typename NodeIteration<T>::Accumulator NodeIteration<T>::displacement(int k) const {
    const auto c = static_cast<std::size_t>(k);
    Accumulator kicks[2] = {Accumulator(0), Accumulator(0)};
    for (int i = 0; i < n_; i += 2)
        for (int l = 0; l < 2; ++l)
            kicks[l] += Accumulator(toEnd_[at(0, i + l)]) * Accumulator(impulse_[at(k, i + l)]);
    const Accumulator drift(velocityToEnd_);
    return drift * Accumulator(v0_[c]) +
           ((kicks[0] + kicks[1]) * Accumulator(inverseMass_[c]) + drift * Accumulator(lost_[c]));
}

/// A sum rounded; what that takes from it is added to the carry.
template <class T>
T NodeIteration<T>::split(const Accumulator& sum, T& carry) {
    const T main = static_cast<T>(sum);
    carry += static_cast<T>(sum - Accumulator(main));
    return main;
}

template <class T>
void NodeIteration<T>::coefficients(Eigen::Ref<Square> Y, Eigen::Ref<Square> forces) const {
    for (int k = 0; k < d_; ++k) {
        const auto c = static_cast<std::size_t>(k);
        for (int a = 0; a < m_; ++a) {
            T sum(0);
            for (int i = 0; i < n_; ++i) sum += toForces_[at(a, i)] * F_[at(k, i)];
            Y(a, k) = toVelocity_[static_cast<std::size_t>(a)] * v0_[c] + sum * inverseMass_[c];
        }
        for (int i = 0; i < n_; ++i) forces(i, k) = F_[at(k, i)];
    }
}

template <class T>
void NodeIteration<T>::remember(const Eigen::Ref<const Square>& forces) {
    for (int k = 0; k < d_; ++k)
        for (int i = 0; i < n_; ++i) F_[at(k, i)] = forces(i, k);
    hasForces_ = true;
}

}  // namespace extremal
