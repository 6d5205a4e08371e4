// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast the corrections of Newton's method with a kept matrix shrink, and how many are left.
///
/// Corrections e_j shrink by a ratio r that the kept matrix has, e_{j+1} = r e_j. It is the largest of those
/// of several measures, as each may be deceived. Unknowns in which the equations are linear, as multipliers,
/// are right after one correction whatever the matrix: the first correction of these says nothing of r. Nor
/// does the relative one of a coordinate at rest, which is larger than 1 or anything. Close to round-off
/// corrections are no longer what shrinks, and the ratio is the last one before.
///
/// T: scalar of the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/newton_policy.hpp"

namespace extremal {

template <class T>
class Contraction {
public:
    explicit Contraction(const NewtonLimits<T>& limits) : limits_(limits) {}

    /// A correction of this relative size; `nonlinear`: that of the unknowns that the matrix depends on;
    /// `metric`: the same in a metric of these unknowns together, in any unit.
    void take(const T& size, const T& nonlinear, const T& metric) {
        const bool isRoundOff = size <= limits_.stagnation, isFirst = !(last_ < infinity);
        if (!isFirst && !(isRoundOff && isKnown_)) {
            ratio_ =
                std::max({ratio(size, last_), ratio(nonlinear, lastNonlinear_), ratio(metric, lastMetric_)});
            isKnown_ = true;
        }
        next_ = ratio_ * (isRoundOff ? std::min(size, next_) : size);
        last_ = std::min(size, T(1));
        lastNonlinear_ = std::min(nonlinear, T(1));
        lastMetric_ = metric;
    }
    /// What the next correction would be.
    T next() const { return next_; }
    /// Whether the next correction would be below the tolerance. A quarter of it, as the second ratio may be
    /// three times the first: e_1 is that of Newton's method, half of what a kept matrix makes of e_0.
    bool isLast() const { return isKnown_ && next_ <= limits_.tolerance / T(4); }
    /// How many more there are with this matrix until one is the last; 0 where they do not shrink.
    T left() const {
        using std::log;
        if (!isKnown_ || isLast() || !(ratio_ < T(1))) return T(0);
        return log(limits_.tolerance / (T(4) * next_)) / log(ratio_);
    }

private:
    static constexpr T infinity = std::numeric_limits<T>::infinity();
    static T ratio(const T& now, const T& before) { return now > T(0) ? T(now / before) : T(0); }

    NewtonLimits<T> limits_;
    T last_ = infinity, lastNonlinear_ = infinity, lastMetric_ = infinity, next_ = infinity, ratio_ = T(1);
    bool isKnown_ = false;
};

}  // namespace extremal
