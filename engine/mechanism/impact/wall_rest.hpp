// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies that rest on walls: their gaps are constraints as long as the walls push.
///
/// With the gaps of the walls that are touched as constraints, d/dt L_v = L_q + F + gap_q^T lambda, the wall
/// pushes where lambda > 0: a wall cannot pull. Of walls that are touched at rest those are left out that
/// would have to pull, the one that pulls most first, until each pushes. The motion is then that of the
/// scheme with one constraint more for each, and so of its order; it ends where a lambda, that of the state
/// (Mechanism::accelerate), passes 0. Contact is without friction, so that bodies slide along their walls.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/own_copy.hpp"
#include "engine/mechanism/impact/wall_gaps.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// The scheme for parts without walls, or whose walls are left alone.
using MakeOfParts = std::function<std::unique_ptr<Integrator>(const Parts&)>;

class WallRest {
public:
    WallRest(const Parts& parts, MakeOfParts make) : parts_(parts), make_(std::move(make)) {}

    bool isOne() const { return !walls_.empty(); }
    /// Also where others hold a body up that touches this one.
    bool holds(int wall) const;
    const std::vector<int>& walls() const { return walls_; }
    Integrator& scheme() { return *scheme_; }
    const Integrator& scheme() const { return *scheme_; }

    /// Rests on those of the walls that push at a state that touches them all, whose momenta are projected:
    /// nothing moves into or out of a wall any more. What would not come out of rounding in a time h is no
    /// push. False, and the state as it was, where none of them pushes, or constraints are not independent.
    bool settle(State& state, std::vector<int> touched, double h);
    /// The same walls again, of a run that goes on.
    void hold(const std::vector<int>& walls);
    void leave() {
        walls_.clear();
        alike_.clear();
    }
    /// Where a wall would have to pull, of the step that scheme() has just taken from `start`: a part of it
    /// before which all push, and one at which one pulls; 0 for both at the start. In so many places.
    std::optional<WallCrossing> lift(const State& start, double h, int places);
    /// The smallest lambda of the walls at a state that rests on them; not a number where it is not
    /// determined.
    double push(double t, const double* x);
    /// Whose it is.
    int weakest(const State& state);

private:
    /// lambda of the walls, in their order; nothing where they are not determined.
    std::optional<Eigen::VectorXd> multipliers(double t, const double* x);
    /// Which of the walls pushes least, and whether it does at all: by how fast a body without it would
    /// enter.
    struct Weakest {
        int wall;
        bool pushes;
    };
    std::optional<Weakest> weakestFor(const State& state, double h);

    Parts parts_;
    MakeOfParts make_;
    std::vector<int> walls_;
    std::vector<int> alike_;              ///< touched as well, and held up by those
    std::optional<Mechanism> mechanism_;  ///< with the gaps of walls_ among its constraints
    OwnCopy<Integrator> scheme_;
    std::vector<double> at_;
};

}  // namespace extremal
