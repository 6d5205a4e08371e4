// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/march_grid.hpp"

#include <algorithm>

#include "engine/scene/bind.hpp"

namespace extremal {

MarchGrid marchGrid(const Scene& scene, const ResolvedScheme& scheme, double step) {
    constexpr double mostOfFirstLength = 100, fewest = 10000;
    const double start = scene.start.value, end = scene.end.value;
    double budget = scene.maxSteps;
    if (scheme.grid == TimeGrid::free)
        budget = std::min(budget, std::max(fewest, mostOfFirstLength * (end - start) / step));
    MarchGrid grid;
    grid.clock = {start, step};
    grid.steps = scheme.isFixed() ? stepCount(start, end, step) : 0;
    grid.end = end;
    grid.isBackwards = isBackwards(scene);
    grid.budget = std::max(grid.steps, static_cast<long long>(std::min(budget, 9e18)));
    return grid;
}

}  // namespace extremal
