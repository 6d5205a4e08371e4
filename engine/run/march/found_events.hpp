// SPDX-License-Identifier: GPL-3.0-or-later
/// What was found of the events of a scene (EventSpec) along the motion of one scheme.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/trajectory/trajectory.hpp"

namespace extremal {

struct FoundEvents {
    static constexpr std::size_t mostRows = 20'000;
    struct Event {
        EventSpec spec;
        long long count = 0;
        double first = std::numeric_limits<double>::quiet_NaN(),
               last = first;  ///< times of the first and last
    };
    std::vector<Event> all;
    /// Where they are: t, the state, which event (its place in `all`) and its direction (1 or -1), in the
    /// order of the motion. Those that are counted only are not here; beyond `mostRows` none is.
    Trajectory rows;
    bool isCut = false;
    int stoppedBy = -1;  ///< the event that ended the run; -1: none

    void checkpoint(Archive& archive) {
        for (Event& event : all) archive(event.count, event.first, event.last);
        archive(rows, isCut, stoppedBy);
    }
};

}  // namespace extremal
