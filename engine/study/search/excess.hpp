// SPDX-License-Identifier: GPL-3.0-or-later
/// How far a run is from what is wished of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/study/search/point.hpp"

namespace extremal {

/// log(value/wish) of the worst wish, one per metric; infinity where the run did not get to its end. Below
/// the floor of the reference, whose own error is `referenceError`, no run is better than another.
inline double excessOf(const PointResult& result, std::span<const Metric> metrics,
                       std::span<const double> wishes, double referenceError) {
    constexpr double least = 1e-300;
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        const double value = result.errorIn(i);
        if (!result.isDone() || !std::isfinite(value)) return HUGE_VAL;
        const double floor = metrics[i].floorBy(referenceError);
        most = std::max(most, std::log(std::max({value, floor, least}) / wishes[i]));
    }
    return most;
}

/// Of two below the floor the one with the smaller number.
inline bool isNearer(const PointResult& a, const PointResult& b) {
    return std::pair(a.excess, a.error) < std::pair(b.excess, b.error);
}

}  // namespace extremal
