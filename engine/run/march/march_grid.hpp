// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a scheme of a scene goes: its nodes, or the end of the run, and its step budget.
#pragma once

#include "engine/run/march/march.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// With this step, or this first step. Steps that are unknowns may shrink: the budget is then a hundred times
/// as many as of the first length.
MarchGrid marchGrid(const Scene& scene, const ResolvedScheme& scheme, double step);

}  // namespace extremal
