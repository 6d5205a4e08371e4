// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the states of a motion stop to be what the mesh can hold, as before a collapse: the run ends there,
/// with the outcome under-resolved, as what it would show beyond is of the mesh.
#pragma once

#include <functional>
#include <string>

#include "engine/core/state.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct ValidityLimit {
    static constexpr PartInfo part{"validity-limit", "an end of what the mesh resolves", false};
    /// Whether a state is still resolved; `energy` is that of the system there. Called at every node.
    using Holds = std::function<bool(double energy, const double* x)>;
    std::function<Holds(const State& start)> from;
    /// For people, of a run that ended at `end`: what happened, and what would help.
    std::function<std::string(const State& start, const State& end)> why;
};

}  // namespace extremal
