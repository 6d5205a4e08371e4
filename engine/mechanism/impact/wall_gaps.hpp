// SPDX-License-Identifier: GPL-3.0-or-later
/// The gaps of walls at states of a motion, and how fast they close.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {

/// A gap that closes: within (from, to] of a step.
struct WallCrossing {
    int wall;
    double from, to;
};

class WallGaps {
public:
    WallGaps(const Wall& wall, const Mechanics<double>& mechanics);

    const Wall& wall() const { return wall_; }
    int count() const { return wall_.count(); }
    /// Finds the gaps at a place, which the other calls are of.
    void find(double t, const double* q) {
        wall_.first(wall_.model.get(), t, q, gaps_.data(), byPlace_.data(), byTime_.data());
    }
    const std::vector<double>& all() const { return gaps_; }
    double operator[](int wall) const { return gaps_[static_cast<std::size_t>(wall)]; }
    const double* normal(int wall) const { return byPlace_.data() + wall * mechanics_.dimension; }
    double byTime(int wall) const { return byTime_[static_cast<std::size_t>(wall)]; }
    /// The size of the numbers that a gap is the sum of, and a depth that rounding makes.
    double terms(int wall, const double* q) const {
        return Wall::terms(normal(wall), q, mechanics_.dimension);
    }
    double roundOff(int wall, const double* q) const { return Wall::rounding * terms(wall, q); }

    /// d gap / dt at a state whose gaps are known; nothing where it has no velocity.
    struct Speed {
        double value = 0;
        bool isGraze = false;  ///< nothing beside the speeds of the motion
    };
    std::optional<Speed> speed(int wall, const State& s);

    /// The first gap that closes inside the step that `step` has just taken from `start`, of length h, looked
    /// at in so many places. `isLeft`: a wall that is left alone up to a part of the step.
    using IsLeft = std::function<bool(int wall, double tau)>;
    std::optional<WallCrossing> firstCrossing(const Integrator& step, const State& start, double h,
                                              int places, const IsLeft& isLeft);

    /// The largest |v_i| that a wall has seen.
    double fastest = 0;

private:
    WallCrossing earliestOf(WallCrossing found, const Integrator& step, const State& start, double h,
                            const double* row, const IsLeft& isLeft);

    Wall wall_;
    Mechanics<double> mechanics_;
    std::vector<double> gaps_, byPlace_, byTime_, velocity_, samples_, at_;
};

}  // namespace extremal
