// SPDX-License-Identifier: GPL-3.0-or-later
/// A sweep: every scheme of a scene over its ladder of steps, each point with its error and its cost. What
/// the studies "convergence", "work-precision" and "cheapest" have in common.
///
/// Points are independent tasks on a pool of threads and are handed on as they finish. The reference is
/// computed once, at the nodes of all steps. A sweep can be split into shards (point i belongs to shard
/// i mod N + 1 of N), and points that are known from an earlier run are not computed again.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/run/comparison.hpp"
#include "engine/run/reference/confirmation.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/search/candidates.hpp"
#include "engine/study/search/knobs.hpp"
#include "engine/study/search/ladder.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/search/point.hpp"
#include "engine/study/search/search_cases.hpp"
#include "engine/study/search/term_costs.hpp"
#include "engine/study/wish.hpp"

namespace extremal {

class CandidateSearch;
struct SearchedScheme;

struct SweepOptions {
    std::string metric = "error";
    bool isAtEnd = false;
    LadderSpec ladder = {};
    int repeat = 5;                      ///< timed runs of a point; 0: costs in calls alone
    std::vector<std::string> only = {};  ///< labels of schemes; empty: all that are enabled
    Shard shard = {};
    /// Above 0: each scheme is one point, what a search for the cheapest with an error of at most this finds
    /// of it (search/candidate_search.hpp).
    double wantedError = 0;
    std::vector<Wish> wishes = {};  ///< of a search: others that must hold as well
    bool hasAllCandidates = false;  ///< of a search: not only the scene's own schemes
    /// Above 0, of a search: not the cheapest for the wishes, but the smallest error for so many seconds of
    /// CPU for a run, and if isPerTime for a unit of its time.
    double budget = 0;
    bool isPerTime = false;
    double mostBytes = 0;      ///< above 0, of a search: that a scheme may hold (CostLimit::bytes)
    OverCases over = {};       ///< of a search: what has to be served besides the scene itself
    SearchKnobs knobs = {};    ///< of a search; of ladders only isCells: mesh and step are refined together
    double searchSeconds = 0;  ///< of CPU; 0: 1 s where runs are timed, else no limit
    /// Of a ladder of wishes, from the largest down: one point for each, the cheapest of all schemes.
    std::vector<double> rungs = {};
    unsigned threads = 0;  ///< 0: as many as the machine has cores
};

/// 0.1, 0.01, ... 1e-12.
std::vector<double> usualRungs();

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
    const Metric& metric() const { return metrics_.front(); }
    /// Of joint wishes all, the one above first.
    const std::vector<Metric>& metrics() const { return metrics_; }
    /// What is wished of them, in the same order.
    std::vector<Wish> wishes() const;
    /// Of a search: its reference beside a method of another kind.
    const Confirmation& confirmation() const { return confirmation_; }
    /// Of a search: why an error this small cannot be judged; empty where it can.
    std::string unjudged(double wish) const;
    /// Of the first metric, in the reference; infinity: not known.
    double metricSize() const { return metricSize_; }
    /// Errors that say something of a scheme: from what the reference can tell up to a fifth of the motion.
    struct ErrorRange {
        double least = 0, most = std::numeric_limits<double>::infinity();
        bool has(double error) const { return error >= least && error < most; }
    };
    ErrorRange judgedErrors() const;
    bool isJudged(const PointResult& result) const {
        return result.isDone() && std::isfinite(result.error) && judgedErrors().has(result.error);
    }
    /// Of all candidates: those that do not accept the system.
    const std::vector<RefusedCandidate>& refused() const { return refused_; }
    /// Whether a scheme is one of the scene, not a candidate that was added.
    bool isOfScene(std::size_t scheme) const { return scheme < ownSchemes_; }
    std::size_t size() const { return rows_.size(); }
    /// Of all points, in order: scheme by scheme, from the largest step down.
    const std::vector<SweepRow>& rows() const { return rows_; }
    const ReferenceInfo& reference() const { return reference_; }
    bool belongsHere(std::size_t point) const { return options_.shard.has(point); }
    /// Of a ladder of wishes that is complete: what each term of the formula costs to leave out; of formulas
    /// without terms, and of others, empty.
    const std::vector<TermCost>& terms() const { return terms_; }
    /// Whether every point, of all shards, is known.
    bool isComplete() const;

    /// Of a ladder of wishes: the cheapest answer to it that is known, which may be that to a smaller one.
    const SweepRow& answer(std::size_t rung) const;

    /// A point that is known already.
    void take(std::size_t point, PointResult result) {
        if (!options_.rungs.empty()) rows_[point].point.scheme = result.scheme;
        rows_[point].result = std::move(result);
    }
    /// The reference of points that are known already.
    void take(ReferenceInfo reference) { reference_ = std::move(reference); }
    void takeSize(double size) { metricSize_ = size; }
    /// Runs what is not known and belongs to the shard. `onPoint` is called for each point that was not
    /// stopped, by one thread at a time; `onReference` before them, when it is known.
    void run(const std::function<void(const ReferenceInfo&)>& onReference,
             const std::function<void(std::size_t, const PointResult&)>& onPoint,
             const std::stop_token& stop);
    /// 0..1; callable while it runs, as are the next.
    double fraction() const { return progress_.fraction(); }
    AnnouncedTime announced() const { return progress_.announced(); }
    /// The reference is computed; no point has begun.
    bool isPreparing() const { return progress_.isPreparing(); }

private:
    using PointReference = std::function<ExactSolution(const StudyPoint&)>;
    double secondsAhead(const std::vector<std::size_t>& wanted, const PointReference& referenceOf,
                        bool isShared, const std::stop_token& stop) const;
    void addOwnPoint(std::size_t scheme);
    bool refinesMesh(const ResolvedScheme& scheme) const;
    void addLadder(std::size_t scheme);
    void addSearched();
    bool isSearch() const { return options_.wantedError != 0 || !options_.rungs.empty(); }
    void climb(CandidateSearch& search, const std::vector<std::size_t>& wanted,
               const std::function<void(std::size_t, const PointResult&)>& onPoint,
               const std::stop_token& stop);
    void checkOptions() const;
    std::vector<SearchCase> casesOf(const std::stop_token& stop) const;
    std::string unjudgedIn(const ResolvedScene& scene, const Confirmation& confirmation, double wish) const;
    std::vector<PointResult> spend(const std::vector<SearchedScheme>& schemes,
                                   const std::vector<Metric>& metrics, const std::vector<double>& wishes,
                                   const SearchReference& reference, double seconds,
                                   const std::stop_token& stop) const;
    void runPoints(const std::vector<std::size_t>& wanted,
                   const std::function<void(const ReferenceInfo&)>& onReference,
                   const std::function<void(std::size_t, const PointResult&)>& onPoint,
                   const std::stop_token& stop);
    void runSearch(const std::vector<std::size_t>& wanted,
                   const std::function<void(const ReferenceInfo&)>& onReference,
                   const std::function<void(std::size_t, const PointResult&)>& onPoint,
                   const std::stop_token& stop);

    ResolvedScene scene_;
    SweepOptions options_;
    std::size_t ownSchemes_ = 0;
    std::vector<RefusedCandidate> refused_;
    std::vector<Metric> metrics_;
    Confirmation confirmation_;
    std::vector<std::shared_ptr<const ResolvedScene>> caseScenes_;  ///< none: the scene alone
    std::vector<SearchCase> cases_;
    double metricSize_ = std::numeric_limits<double>::infinity();  ///< of the first metric
    std::vector<SweepRow> rows_;
    std::vector<SweepRow> searched_;  ///< of a ladder of wishes: the schemes that it is climbed with
    std::vector<TermCost> terms_;
    std::vector<double> steps_;  ///< that the reference must know: a row of it each
    ReferenceInfo reference_;
    StudyProgress progress_;
};

/// Whether any has a mesh of its own, beside that of its scheme.
bool areMeshesRefined(std::span<const SweepRow> rows);
/// The elements of a point on a mesh; 0: their number is not a knob of its scheme.
int cellsAt(const Sweep& sweep, const StudyPoint& point);

/// The rows of a sweep that belong to one scheme, for each scheme that has any.
struct SchemeRows {
    std::size_t scheme = 0;
    std::span<const SweepRow> rows;
};
std::vector<SchemeRows> bySchemes(const Sweep& sweep);

}  // namespace extremal
