// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest step, or tolerance, with which a scheme keeps its error below a wanted one.
///
/// The number of steps n (or 1/tolerance) is bracketed from the scheme's own step, extrapolated by the
/// claimed order, and narrowed by the secant in log error over log n until the ends are 3 % apart (20 % for
/// tolerances). Errors are taken to fall with the step; where they do not, the step that is found reaches the
/// error all the same, but need not be the largest.
///
/// Then the same is asked of the scheme with a smaller degree or with fewer nodes (reductions.hpp), within
/// the steps with which it could be cheaper: the cheapest is the result.
#pragma once

#include <functional>

#include "engine/study/search/point.hpp"

namespace extremal {

/// `run(point, repeat)`: as runPoint. The point found, timed `repeat` times; where none reaches the error
/// within `mostSteps`, or errors stop falling, the nearest one, with status `failed`.
PointResult searchPoint(const ResolvedScene& scene, const StudyPoint& own, double wanted, int repeat,
                        const std::function<PointResult(const StudyPoint&, int repeat)>& run,
                        double mostSteps = 1e7);

}  // namespace extremal
