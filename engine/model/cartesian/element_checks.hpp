// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong with elements that are well formed each by itself: places, lengths and ends. Internal to
/// engine/model/cartesian.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/cartesian/elements.hpp"

namespace extremal::cartesian {

/// Empty where all is well.
std::vector<Problem> geometryProblems(const Elements& elements);

/// The gaps of a wall at a place, with the ending of the name of each ("" or "_left"): a straight wall
/// n . (r - r0) with |n| = 1, a disc (|r - c|^2 - R^2) / 2R, a box four straight walls.
struct Side {
    std::string ending;
    /// gap = sign ((x - cx)^2 + (y - cy)^2 - R^2) / 2R, or nx (x - cx) + ny (y - cy) with R = 0.
    std::array<double, 2> centre{}, normal{};
    double radius = 0, sign = 1;
    double gap(const std::array<double, 2>& place) const;
};
std::vector<Side> sidesOf(const WallElement& wall);

}  // namespace extremal::cartesian
