// SPDX-License-Identifier: GPL-3.0-or-later
/// A sweep: every scheme of a scene over its ladder of steps, each point with its error and its cost. What
/// the studies "convergence", "work-precision" and "cheapest" have in common.
///
/// Points are independent tasks on a pool of threads and are handed on as they finish. The reference is
/// computed once, at the nodes of all steps. A sweep can be split into shards (point i belongs to shard
/// i mod N + 1 of N), and points that are known from an earlier run are not computed again.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/run/comparison.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/search/ladder.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/search/point.hpp"
#include "engine/study/search/prospect.hpp"

namespace extremal {

struct SweepOptions {
    std::string metric = "error";
    bool isAtEnd = false;
    LadderSpec ladder = {};
    int repeat = 5;                      ///< timed runs of a point; 0: costs in calls alone
    std::vector<std::string> only = {};  ///< labels of schemes; empty: all that are enabled
    Shard shard = {};
    /// Above 0: each scheme is one point, the largest step (or tolerance) found with an error of at most
    /// this.
    double wantedError = 0;
    unsigned threads = 0;  ///< 0: as many as the machine has cores
};

/// A point and what came out of it; status `waiting` where it has not been run.
struct SweepRow {
    StudyPoint point;
    PointResult result;
};

class Sweep {
public:
    /// Throws InvalidScene: pointers are options ("--metric", "--only", "--shard", ...).
    Sweep(ResolvedScene scene, SweepOptions options);

    const ResolvedScene& scene() const { return scene_; }
    const SweepOptions& options() const { return options_; }
    const Metric& metric() const { return metric_; }
    std::size_t size() const { return rows_.size(); }
    /// Of all points, in order: scheme by scheme, from the largest step down.
    const std::vector<SweepRow>& rows() const { return rows_; }
    const ReferenceInfo& reference() const { return reference_; }
    bool belongsHere(std::size_t point) const { return options_.shard.has(point); }
    /// Whether every point, of all shards, is known.
    bool isComplete() const;

    /// A point that is known already.
    void take(std::size_t point, PointResult result) { rows_[point].result = std::move(result); }
    /// The reference of points that are known already.
    void take(ReferenceInfo reference) { reference_ = std::move(reference); }
    /// Runs what is not known and belongs to the shard. `onPoint` is called for each point that was not
    /// stopped, by one thread at a time; `onReference` before them, when it is known.
    void run(const std::function<void(const ReferenceInfo&)>& onReference,
             const std::function<void(std::size_t, const PointResult&)>& onPoint,
             const std::stop_token& stop);
    /// 0..1; callable while it runs, as is the next.
    double fraction() const { return progress_.fraction(); }
    /// The reference is computed; no point has begun.
    bool isPreparing() const { return progress_.isPreparing(); }

private:
    void addOwnPoint(std::size_t scheme);
    void addLadder(std::size_t scheme);
    using Run = std::function<PointResult(const StudyPoint&, int repeat)>;
    std::vector<Prospect> prospects(const Run& run, const std::stop_token& stop) const;
    PointResult search(const StudyPoint& point, const Prospect& prospect, double least, const Run& run) const;

    ResolvedScene scene_;
    SweepOptions options_;
    Metric metric_;
    std::vector<SweepRow> rows_;
    std::vector<double> steps_;  ///< that the reference must know: a row of it each
    ReferenceInfo reference_;
    StudyProgress progress_;
};

/// The rows of a sweep that belong to one scheme, for each scheme that has any.
struct SchemeRows {
    std::size_t scheme = 0;
    std::span<const SweepRow> rows;
};
std::vector<SchemeRows> bySchemes(const Sweep& sweep);

}  // namespace extremal
