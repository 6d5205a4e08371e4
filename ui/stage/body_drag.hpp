// SPDX-License-Identifier: GPL-3.0-or-later
/// A body of the stage that is moved by hand: which state draws it where the pointer is.
///
/// A body is held at a disc, or at a corner of a solid, of the drawing of a state: at the point c(q). It is
/// moved to a target r by the least change of the coordinates,
///
///     dq = J^T (J J^T + eps)^-1 (r - c),   J = dc/dq by differences, repeated,
///
/// so that a bob of a pendulum goes to the nearest place of its circle, and one of a chain takes along what
/// hangs on it. What has constraints is projected onto them (engine/mechanism/mechanism_start.hpp). A throw
/// changes the velocities by the least that gives the point its velocity, and keeps constraints likewise. Of
/// a state that is more than coordinates, as an attitude is, dq is what its model takes for displacements
/// (engine/model/parts/by_hand.hpp). Fields and waves are not moved so.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/drawing.hpp"
#include "engine/model/parts/by_hand.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The point of a drawing that is held: the centre of a disc, or a corner of a solid.
struct HeldPoint {
    std::size_t shape = 0;  ///< its place among the shapes
    std::size_t corner = 0;
    std::optional<Point> in(const Drawing& drawing) const;
};

/// Whether the drawing of the system has bodies that can be moved.
bool hasMovableBodies(const System& system);

class BodyDrag {
public:
    BodyDrag(std::shared_ptr<const System> system, State state, HeldPoint held);

    /// Goes as near to the target as the body can; false: it stays where it is.
    bool moveTo(const Point& target);
    /// Gives the body a velocity, in lengths of the picture per unit of time; false: it has none.
    bool throwWith(const Point& velocity);

    Point place() const { return placeOf(state_.x); }
    const State& state() const { return state_; }
    const System& system() const { return *system_; }
    const HeldPoint& held() const { return held_; }
    /// The velocities of all coordinates after a throw; empty where the state is more than these.
    const std::vector<double>& velocity() const { return velocity_; }
    Drawing drawing() const;

private:
    Point placeOf(const std::vector<double>& x) const;
    std::size_t freedoms() const;
    std::vector<double> displaced(std::vector<double> x, const std::vector<double>& by) const;
    /// Three rows, one column per number of a displacement.
    std::vector<double> slope() const;
    bool throwByHand(const Point& velocity);

    std::shared_ptr<const System> system_;
    const ByHand* hand_;  ///< of a state that is more than coordinates; else null
    State state_;
    HeldPoint held_;
    std::vector<double> velocity_;
};

}  // namespace extremal
