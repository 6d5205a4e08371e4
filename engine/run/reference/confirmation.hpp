// SPDX-License-Identifier: GPL-3.0-or-later
/// A computed reference beside a run of a method of another kind, on steps of its own: two step sizes of one
/// method may err to the same side, and their difference is no bound.
///
///     d(t) = max over s <= t of |x_ref(s) - x(s)|,   bound(t) = 3 d(t)
///
/// x is that of the explicit pair rk8pd, else fehlberg78, at a tolerance of 1e-13. Where a motion is chaotic
/// the two part, and beyond that time an error against either of them says nothing.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

struct Confirmation {
    static constexpr double safety = 3;
    struct Part {
        double t = 0, distance = 0;
    };
    std::string by;           ///< the method; empty: no method of another kind reached the end
    std::vector<Part> parts;  ///< d(t), by time; it grows

    explicit operator bool() const { return !by.empty() && !parts.empty(); }
    double bound() const { return safety * parts.back().distance; }
    /// The last time up to which the bound is at most this.
    double judgedTo(double error) const;
};

/// What is compared: a number that the values of errorMeasure() at one node give.
using DistanceOf = std::function<double(std::span<const double> values)>;

/// Of a system with coordinates; without a method where the run takes more than 200,000 steps.
Confirmation confirm(const ResolvedScene& scene, const ExactSolution& reference, const DistanceOf& distance,
                     const std::stop_token& stop);

}  // namespace extremal
