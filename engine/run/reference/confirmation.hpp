// SPDX-License-Identifier: GPL-3.0-or-later
/// How far two routes to a reference are apart, in a number of the user: what members.hpp finds of the
/// states, as a metric sees it.
///
///     d(t) = max over s <= t of the distance at s,   bound(t) = 3 d(t)
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace extremal {

struct Confirmation {
    static constexpr double safety = 3;
    struct Part {
        double t = 0, distance = 0;
    };
    std::string by;           ///< the other method; empty: no method of another kind reached the end
    std::vector<Part> parts;  ///< d(t), by time; it grows

    explicit operator bool() const { return !by.empty() && !parts.empty(); }
    double bound() const { return safety * parts.back().distance; }
    /// The last time up to which the bound is at most this.
    double judgedTo(double error) const;
};

/// What is compared: a number that the values of errorMeasure() at one node give.
using DistanceOf = std::function<double(std::span<const double> values)>;

}  // namespace extremal
