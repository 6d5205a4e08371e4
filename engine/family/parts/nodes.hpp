// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts that say at which times the solutions of a family are known.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// Who chooses the times of the nodes, for the schemes of a space. Where it is TimeGrid::free, the step of a
/// scheme is its first. Without it the nodes are equally spaced: TimeGrid::fixed.
struct OwnTimeGrid {
    static constexpr PartInfo part{"time-grid", "times of nodes", false};
    TimeGrid (*of)(const Settings& space) = nullptr;
};

/// There is no dense output: a solution between nodes is computed anew, and solutions are compared at nodes.
/// Without it solutions are read off between nodes.
struct NodesAlone {
    static constexpr PartInfo part{"nodes-alone", "solutions at nodes alone", false};
};

}  // namespace extremal
