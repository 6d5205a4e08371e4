// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in space as its elements: rigid bodies and points, and what joins, pulls, turns and stops
/// them.
///
/// Lengths in m, masses in kg, angles in rad; z points up. A point r of a body has the place
///     x + r_1 d_1 + r_2 d_2 + r_3 d_3,
/// x the centre of mass and d_j the body's axes in space, the columns of its attitude R. Errors: InvalidScene
/// with pointers below /model ("/joints/neck/axis") that name the element.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/cartesian/elements.hpp"

namespace extremal::spatial {

using cartesian::Amount;
using cartesian::DamperElement;
using cartesian::RodElement;
using cartesian::SpringElement;
using Place = Eigen::Vector3d;
using Axes = Eigen::Matrix3d;
using Amounts = std::array<Amount, 3>;

struct BodyElement {
    std::string name;
    Amount mass;
    /// About the centre of mass, in body axes: three principal moments; or six numbers, those of the diagonal
    /// and then I23, I13, I12.
    std::vector<Amount> inertia;
    Place at = Place::Zero();
    Axes attitude = Axes::Identity();
    Place velocity = Place::Zero();
    bool hasVelocity = false;                                      ///< else it follows from the joints
    Place spin = Place::Zero();                                    ///< angular velocity in body axes
    enum class Shape { box, ellipsoid, ring } shape = Shape::box;  ///< on the stage
    std::optional<int> thinAxis;  ///< a flat body's normal: d_j is the cross product of the other two
    /// sum rho X_j X_k over the body, half the trace of the inertia less the inertia: the mass matrix of d_j.
    Axes spread() const;
};
/// Where it stands is what its numbers say at the start.
struct PointElement {
    std::string name;
    std::optional<Amount> mass;
    Amounts at;
    Place velocity = Place::Zero();
    bool isFixed = false;
    std::optional<std::size_t> body;
    bool isFree() const { return !isFixed && !body; }
};
struct JointElement {
    enum class Kind { ball, hinge, universal, slider, cylinder, weld };
    std::string name;
    Kind kind = Kind::ball;
    std::size_t body = 0;
    std::optional<std::size_t> to;                                             ///< nothing: the ground
    Place at = Place::Zero(), axis = Place::UnitZ(), second = Place::UnitX();  ///< in space, at the start
    Amount damping;
};
struct MotorElement {
    std::string name;
    std::optional<std::size_t> joint, body;
    Place axis = Place::UnitZ();  ///< of a body: in its axes
    Amount torque;                ///< the formula may have t in it, and has no value then
};
struct WallElement {
    std::string name;
    Place through = Place::Zero(), normal = Place::UnitZ();
    std::vector<std::size_t> points;
    Amount restitution;
};

struct Assembly {
    std::vector<std::pair<std::string, double>> parameters;
    Amount gravity;
    std::vector<BodyElement> bodies;
    std::vector<PointElement> points;
    std::vector<JointElement> joints;
    std::vector<RodElement> rods;
    std::vector<SpringElement> springs;
    std::vector<DamperElement> dampers;
    std::vector<MotorElement> motors;
    std::vector<WallElement> walls;
};

/// The elements of a model, each by itself and all together checked. Velocities of bodies that are left out
/// are those that joints leave them, from the ground on.
Assembly assemblyOf(const Settings& settings);

/// Where a point is at the start.
Place placeAtStart(const Assembly& assembly, std::size_t point);
/// The distance of the ends of a link at the start.
double lengthAtStart(const Assembly& assembly, const cartesian::Link& link);
/// Two unit vectors normal to a unit vector and to each other, along axes where it is along one.
std::array<Place, 2> acrossOf(const Place& axis);

}  // namespace extremal::spatial
