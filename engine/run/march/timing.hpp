// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run costs, from repetitions of it without observers.
///
/// A single short run says little: the clock of a thread has a grain, caches and branches are cold, and a
/// page of memory that is met for the first time costs more than many a step. Repetitions of one measurement
/// follow each other until it is long enough. Of several measurements the median says what a run costs as the
/// machine is, and the fastest run what it costs by itself: other work on the machine, and an unlucky place
/// in memory, can only add to it.
#pragma once

#include <limits>
#include <stop_token>

#include "engine/run/march/march.hpp"
#include "engine/run/march/motion_check.hpp"

namespace extremal {

struct Timing {
    double seconds = std::numeric_limits<double>::quiet_NaN();  ///< of one run: the median
    double fastest = seconds;                                   ///< of the fastest of all runs
    double spread = seconds;  ///< half the distance between the fastest and the slowest measurement
};

struct TimingPlan {
    int repeat = 5;          ///< measurements
    double shortest = 2e-3;  ///< CPU seconds of one measurement
    double longest = 2;      ///< of all of them: slow runs have fewer
    int together = 10000;    ///< at most, repetitions of one measurement
};
/// Of runs too short to be timed by themselves.
inline constexpr TimingPlan shortRun{5, 1e-3, 3e-2, 100};
inline constexpr double shortRuns = 1.5e-2;  ///< seconds: below it

/// CPU seconds of the steps. `integrator` is as it was before a run, and stays so. `first`: about what a run
/// takes. Unknown where it was stopped. `motion`: as it is before a run that it may end; each has a copy.
Timing timeRuns(const Integrator& integrator, const State& start, const MarchGrid& grid, double first,
                const TimingPlan& plan, const std::stop_token& stop, const MotionCheck* motion = nullptr);

}  // namespace extremal
