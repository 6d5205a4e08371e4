// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in the plane as its elements: points and rigid bodies, and what joins, pulls and stops them.
///
/// Lengths in m, masses in kg, angles in rad; y points up. A point of a body has the place
///     x = X + a cos phi - b sin phi,   y = Y + a sin phi + b cos phi
/// with (a, b) in the body. Errors: InvalidScene with pointers below /model ("/rods/crank/to") that name the
/// element.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal::cartesian {

/// A number, and the formula in parameters that it was typed as; empty: it was typed as a number.
struct Amount {
    double value = 0;
    std::string formula = {};
};
struct Vector {
    Amount x, y;
};

struct PointElement {
    std::string name;
    std::optional<Amount> mass;
    Vector at, velocity;
    bool isFixed = false;
    std::optional<std::size_t> body;
    bool isFree() const { return !isFixed && !body; }
};
struct BodyElement {
    std::string name;
    Amount mass, inertia;
    Vector at;
    Amount angle;
    Vector velocity;
    Amount spin;
};
/// Between two points.
struct Link {
    std::string name;
    std::size_t from = 0, to = 0;
};
struct RodElement : Link {
    std::optional<Amount> length;
};
struct SpringElement : Link {
    Amount stiffness, damping;
    std::optional<Amount> length;
};
struct SliderElement {
    std::string name;
    std::size_t point = 0;
    Vector through, direction;
};
struct DamperElement {
    std::string name;
    std::optional<std::size_t> from, to, body;
    Amount damping;
};
struct MotorElement {
    enum class Drive { torque, angle, speed };
    std::string name;
    std::optional<std::size_t> body, rod;
    Drive drive = Drive::torque;
    Amount amount;  ///< torque and angle: the formula may have t in it, and has no value then
};
struct WallElement {
    enum class Shape { line, disc, box };
    std::string name;
    Shape shape = Shape::line;
    std::vector<std::size_t> points;
    Amount restitution;
    Vector first, second;  ///< a point and the normal, the middle, or two corners
    Amount radius;
    bool isInside = false;
};

struct Elements {
    std::vector<std::pair<std::string, double>> parameters;
    Amount gravity;
    std::vector<PointElement> points;
    std::vector<BodyElement> bodies;
    std::vector<RodElement> rods;
    std::vector<Link> pins;
    std::vector<SliderElement> sliders;
    std::vector<SpringElement> springs;
    std::vector<DamperElement> dampers;
    std::vector<MotorElement> motors;
    std::vector<WallElement> walls;
};

/// The elements of a model, each by itself and all together checked.
Elements elementsOf(const Settings& settings);

/// Where a point is at the start.
std::array<double, 2> placeAtStart(const Elements& elements, std::size_t point);
/// The distance of the ends of a link at the start.
double lengthAtStart(const Elements& elements, const Link& link);
/// The fixed end of a rod that has one.
std::optional<std::size_t> fixedEnd(const Elements& elements, const RodElement& rod);

}  // namespace extremal::cartesian
