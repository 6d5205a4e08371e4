// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong with elements that are well formed each by itself: places, lengths and ends. Internal to
/// engine/model/cartesian.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/cartesian/elements.hpp"

namespace extremal::cartesian {

/// What is wrong with the ends of a link of elements in the plane or in space; nothing where all is well.
template <class All>
std::optional<Problem> endsProblem(const All& all, const Link& link, const std::string& pointer,
                                   const std::string& what) {
    const auto &from = all.points[link.from], &to = all.points[link.to];
    if (link.from == link.to) return Problem{pointer, "both ends are the point " + from.name, "two points"};
    if (from.isFixed && to.isFixed)
        return Problem{pointer, "both ends are fixed: the " + what + " changes nothing", "leave it out"};
    if (from.body && from.body == to.body)
        return Problem{pointer, "both ends belong to the body " + all.bodies[*from.body].name,
                       "leave it out"};
    return {};
}

/// The same of a spring; `near`: a length that is nothing beside the mechanism.
template <class All>
std::optional<Problem> springProblem(const All& all, const SpringElement& spring, double near) {
    const std::string pointer = "/springs/" + spring.name;
    if (auto problem = endsProblem(all, spring, pointer, "spring")) return problem;
    const double now = lengthAtStart(all, spring), rest = spring.length ? spring.length->value : now;
    if (!(now <= near && rest > 0)) return {};
    return Problem{pointer, "has its ends at one place at the start, where its direction is not known",
                   "move one of them, or \"length\": 0"};
}
/// And of a damper.
template <class All>
std::optional<Problem> damperProblem(const All& all, const DamperElement& damper, double near) {
    const std::string pointer = "/dampers/" + damper.name;
    if (damper.body) return {};
    const auto& from = all.points[*damper.from];
    if (!damper.to && from.isFixed)
        return Problem{pointer, "the point " + from.name + " is fixed: it damps nothing",
                       "a point that moves, or a second one"};
    if (!damper.to) return {};
    const Link link{damper.name, *damper.from, *damper.to};
    if (auto problem = endsProblem(all, link, pointer, "damper")) return problem;
    if (!(lengthAtStart(all, link) <= near)) return {};
    return Problem{pointer, "has its ends at one place at the start, where its direction is not known",
                   "move one of them"};
}

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
