// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/prospect.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

Prospect prospectOf(const ResolvedScheme& scheme, const PointResult& first, double wantedError) {
    if (scheme.isAdaptive() || scheme.claims.order < 1 || !first.isDone() || first.steps < 1) return {};
    if (first.cost.evaluations == 0 || !(std::isfinite(first.error) && first.error > 0)) return {};
    const double work = static_cast<double>(first.cost.evaluations),
                 factor = std::pow(first.error / wantedError, 1.0 / scheme.claims.order);
    return {work * std::max(factor, 0.125), work / static_cast<double>(first.steps)};
}

double leastWork(std::span<const Prospect> prospects) {
    double least = HUGE_VAL;
    for (const Prospect& p : prospects)
        if (p.work < least) least = p.work;
    return least;
}

}  // namespace extremal
