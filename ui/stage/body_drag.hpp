// SPDX-License-Identifier: GPL-3.0-or-later
/// A body of the stage that is moved by hand: which state draws it where the pointer is.
///
/// A body is a disc of the drawing of a state, c(q). It is moved to a target r by the least change of the
/// coordinates,
///
///     dq = J^T (J J^T + eps)^-1 (r - c),   J = dc/dq by differences, repeated,
///
/// so that a bob of a pendulum goes to the nearest place of its circle, and one of a chain takes along what
/// hangs on it. What has constraints is projected onto them (engine/mechanism/mechanism_start.hpp). A throw
/// changes the velocities by the least that gives the body its velocity, and keeps constraints likewise.
/// Bodies without coordinates (rigid bodies, fields, waves) are not moved so.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/drawing.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Whether the drawing of the system has bodies that can be moved.
bool hasMovableBodies(const System& system);

class BodyDrag {
public:
    /// `shape`: the place of the disc among the shapes of the drawing.
    BodyDrag(std::shared_ptr<const System> system, State state, std::size_t shape);

    /// Goes as near to the target as the body can; false: it stays where it is.
    bool moveTo(const Point& target);
    /// Gives the body a velocity, in lengths of the picture per unit of time; false: it has none.
    bool throwWith(const Point& velocity);

    Point place() const { return placeOf(state_.x); }
    const State& state() const { return state_; }
    /// The velocities of all coordinates after a throw.
    const std::vector<double>& velocity() const { return velocity_; }
    Drawing drawing() const;

private:
    Point placeOf(const std::vector<double>& x) const;
    /// Three rows, one column per coordinate.
    std::vector<double> slope() const;

    std::shared_ptr<const System> system_;
    State state_;
    std::size_t shape_;
    std::vector<double> velocity_;
};

}  // namespace extremal
