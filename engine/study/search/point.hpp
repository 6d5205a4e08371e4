// SPDX-License-Identifier: GPL-3.0-or-later
/// One point of a study: a scheme of the scene with one step (or tolerance), run once for its errors and then
/// again, without observers, for its cost.
///
/// cpuSeconds is the thread's CPU time of the steps alone, the median of the repeated runs; what is prepared
/// once (tables, poles, plans) is not in it. Runs shorter than 2 ms are repeated within one measurement, and
/// no point is timed for much longer than 2 s: slow points have fewer repetitions. Everything but the times
/// is the same for any order and any number of threads.
#pragma once

#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/processor_watch.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/run/comparison.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/search/reductions.hpp"

namespace extremal {

struct StudyPoint {
    std::size_t scheme = 0;  ///< index in the scene
    double step = 0;         ///< 0 for adaptive schemes
    double tolerance = 0;    ///< 0 for those with steps
    std::size_t row = 0;     ///< of the reference: which of the study's steps
    Reduction reduction = {};
};

/// A run that a search has made.
struct TriedRun {
    double cost = 0, error = 0;  ///< seconds of CPU, or where runs are not timed, evaluations
    double steps = 0;            ///< or 1/tolerance
    int cells = 0;               ///< of schemes on meshes
    bool operator==(const TriedRun&) const = default;
};

struct PointResult {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    RunStatus status = RunStatus::waiting;
    Outcome cause = Outcome::converged;
    double failedAt = unknown;
    double error = unknown;           ///< the metric; of a failed run up to its last node
    std::vector<double> errors = {};  ///< of joint wishes, all metrics, the one above first; else empty
    /// The error in a metric of a search, which may be the only one.
    double errorIn(std::size_t metric) const { return errors.empty() ? error : errors[metric]; }
    double step = 0, tolerance = 0;  ///< where it was measured: of the point, or what a search found
    Reduction reduction = {};
    double unreducedWork = unknown;  ///< of a reduced scheme: what the error takes of the scheme as it is
    /// Of a search that was given up: the evaluations that the wanted error takes, over those of the cheapest
    /// scheme; at least so many.
    double timesCheapest = unknown;
    long long steps = 0;
    Cost cost = {};
    double cpuSeconds = unknown;        ///< median
    double predictedSeconds = unknown;  ///< of a search: what a trial of a few steps says of the run
    double cpuSpread = unknown;         ///< half the distance between the fastest and the slowest repetition
    bool isCutOff = false;              ///< by a limit of its cost
    double bytes = unknown;             ///< where they are limited: what a run of the scheme holds
    // Of a search:
    std::size_t scheme = 0;            ///< of a ladder of wishes: which one answers
    double excess = unknown;           ///< log of the largest error over what is wished of it
    double floor = unknown;            ///< the error below which nothing is known of the scheme
    std::string floorOf;               ///< "reference", "round-off", "mesh", "model"; empty: unknown
    double confirmedAt = unknown;      ///< the finer step or tolerance at which the wish was reached as well
    std::string reason;                ///< why it was refused, or what the search found, in words
    std::vector<TriedRun> tried = {};  ///< of a search: its runs that ended, from few steps to many

    bool isDone() const { return status == RunStatus::done; }
};

/// Where a run is cut off, as it is not worth more.
struct CostLimit {
    double seconds = std::numeric_limits<double>::infinity();
    double work = std::numeric_limits<double>::infinity();  ///< as workOf()
    /// That a run holds for itself: its state and the buffers of its steps, not tables and plans that all
    /// runs of a scheme share. A scheme with more is refused.
    double bytes = std::numeric_limits<double>::infinity();
    /// Cuts it off in the middle of a step as well; null: after some steps only.
    ProcessorWatch* watch = nullptr;
};

/// What a step costs at the beginning of a run, from a few of them; unknown where one of them fails.
struct StepCost {
    double seconds = PointResult::unknown, work = PointResult::unknown;
    double steps = 0;       ///< that the whole run takes, if all are as long
    bool isCutOff = false;  ///< there was not enough time for them
};

/// Evaluations, or where none are counted, steps times nodes: a cost that is the same on every machine.
double workOf(const PointResult& result, int nodes);
/// The scheme of the scene with the reduction of a point.
ResolvedScheme schemeOf(const ResolvedScene& scene, const StudyPoint& point);
/// The scheme of the scene with the reduction, step or tolerance of a result.
ResolvedScheme schemeAt(const ResolvedScene& scene, std::size_t scheme, const PointResult& result);

/// Runs it. `reference`: empty where the metric needs none or there is none. `repeat`: timed runs, 0 for
/// none. Status `partial` where it was stopped.
PointResult runPoint(const ResolvedScene& scene, const StudyPoint& point, const Metric& metric,
                     ExactSolution reference, int repeat, const std::stop_token& stop);
/// The same of several metrics in one run.
PointResult runPoint(const ResolvedScene& scene, const StudyPoint& point, std::span<const Metric> metrics,
                     ExactSolution reference, int repeat, const CostLimit& limit,
                     const std::stop_token& stop);
/// What runPoint should take: `run`: CPU seconds of the steps of one run.
double secondsOfPoint(double run, int repeat);
/// Of at most so many steps, which take at most `limit.seconds`.
StepCost tryPoint(const ResolvedScene& scene, const StudyPoint& point, long long steps,
                  const CostLimit& limit, const std::stop_token& stop);

}  // namespace extremal
