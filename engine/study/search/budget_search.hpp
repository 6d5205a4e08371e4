// SPDX-License-Identifier: GPL-3.0-or-later
/// The other direction of the trade: of many candidates the smallest error that a budget of CPU time buys.
///
/// Of each candidate the most steps, or the smallest tolerance, whose run keeps within the budget: begun at
/// what a few steps cost, and corrected by what whole runs have cost until they use 0.8 to 1 of it. A half
/// and a fifth of that are tried as well, as more steps are not always better. Its answer is the run with the
/// least excess among those within the budget; the least of all answers wins.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/study/search/point.hpp"

namespace extremal {

struct BudgetSearch {
    const ResolvedScene& scene;
    std::span<const StudyPoint> candidates;  ///< as the scene has them
    std::span<const Metric> metrics;
    std::span<const double> wishes;  ///< one per metric: what errors are compared by
    std::function<ExactSolution(const StudyPoint&)> reference;
    double referenceError = 0;                               ///< its own: no run is better than that
    double budget = 0;                                       ///< seconds of CPU for a run
    double seconds = 1;                                      ///< of CPU for the search
    double bytes = std::numeric_limits<double>::infinity();  ///< that a scheme may hold (CostLimit)
    int repeat = 5;                                          ///< timed runs of the best three
};

/// One result per candidate: status done and the excess where a run keeps within the budget; else failed,
/// with the reason.
std::vector<PointResult> bestWithin(const BudgetSearch& search, const std::stop_token& stop);

}  // namespace extremal
