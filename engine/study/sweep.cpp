// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/pool.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/reference/map_reference.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/search/budget_search.hpp"
#include "engine/study/search/candidate_search.hpp"
#include "engine/study/search/search_reference.hpp"
#include "engine/study/usable_value.hpp"

namespace extremal {

namespace {

/// Of a reference that is asked itself.
constexpr std::size_t noRow = std::numeric_limits<std::size_t>::max();

/// No scheme is to blame.
PointResult notJudged(const std::string& reason) {
    PointResult result;
    result.status = RunStatus::failed;
    result.floorOf = "reference";
    result.reason = reason;
    return result;
}

Metric sized(const Metric& metric, const ResolvedScene& scene, const ExactSolution& solution) {
    return withSizes(metric, solution, scene.scene.start.value, scene.scene.end.value,
                     scene.initial.x.size());
}

}  // namespace

std::vector<double> usualRungs() {
    constexpr int mostDigits = 12;
    std::vector<double> all;
    for (int digits = 1; digits <= mostDigits; ++digits) all.push_back(std::pow(10.0, -digits));
    return all;
}

Sweep::Sweep(ResolvedScene scene, SweepOptions options)
    : scene_(std::move(scene)), options_(std::move(options)), ownSchemes_(scene_.schemes.size()) {
    for (const Wish& wish : wishes())
        metrics_.push_back(metricOf(wish.metric, options_.isAtEnd, *scene_.system, scene_.initial));
    checkOptions();
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only))
        if (isSearch())
            addOwnPoint(scheme);
        else
            addLadder(scheme);
    if (options_.hasAllCandidates) addSearched();
    if (options_.over.isGiven()) caseScenes_ = scenesOf(scene_, options_.over);
    if (options_.rungs.empty()) return;
    searched_ = std::move(rows_);
    rows_.assign(options_.rungs.size(), SweepRow{searched_.front().point, {}});
}

std::vector<Wish> Sweep::wishes() const {
    std::vector<Wish> all{{options_.metric, options_.wantedError}};
    all.insert(all.end(), options_.wishes.begin(), options_.wishes.end());
    return all;
}

void Sweep::checkOptions() const {
    requireShard(options_.shard);
    if (options_.repeat < 0 || options_.repeat > 1000)
        throw InvalidScene("--repeat", "must be 0 to 1000, got " + std::to_string(options_.repeat));
    for (const Metric& metric : metrics_)
        if (metric.needsReference() && scene_.scene.reference.kind == ReferenceSpec::Kind::none)
            throw InvalidScene("/reference", "errors need a reference, and the scene has none",
                               "\"auto\", or --metric energy");
    if (options_.wantedError != 0) requireUsable(options_.wantedError, "--error");
    for (const Wish& wish : options_.wishes) requireUsable(wish.value, "--wish");
    for (const double rung : options_.rungs) requireUsable(rung, "--wish");
    if (options_.searchSeconds != 0) requireUsable(options_.searchSeconds, "--search-time");
    if (options_.budget != 0) requireUsable(options_.budget, "--budget");
    if (options_.mostBytes != 0) requireUsable(options_.mostBytes, "--memory");
    if (options_.budget != 0 && options_.over.isGiven())
        throw InvalidScene("--over", "does not go with --budget", "--wish or --error");
    if (options_.budget != 0 && options_.repeat == 0)
        throw InvalidScene("--budget", "is CPU time, which --repeat 0 does not measure", "--repeat 1");
}

/// What the scene does not have itself.
void Sweep::addSearched() {
    Candidates all = candidatesFor(scene_);
    scene_ = std::move(all.scene);
    refused_ = std::move(all.refused);
    for (std::size_t scheme = ownSchemes_; scheme < scene_.schemes.size(); ++scheme) addOwnPoint(scheme);
}

/// Where a search begins. No table of the reference has the nodes that it will ask for.
void Sweep::addOwnPoint(std::size_t scheme) {
    const ResolvedScheme& own = scene_.schemes[scheme];
    StudyPoint point;
    point.scheme = scheme;
    if (own.isAdaptive())
        point.tolerance = own.spec.tolerance.value_or(1e-6);
    else
        point.step = own.spec.step.value;
    point.row = noRow;
    rows_.push_back({point, {}});
}

/// Whether a ladder has a mesh of its own at each step: of errors against a solution that is known on any.
bool Sweep::refinesMesh(const ResolvedScheme& scheme) const {
    const ReferenceSpec::Kind kind = scene_.scene.reference.kind;
    const bool isOnAnyMesh =
        scene_.system->at && (kind == ReferenceSpec::Kind::automatic || kind == ReferenceSpec::Kind::exact);
    return options_.knobs.isCells && isOnAnyMesh && metric().needsReference() &&
           !hasStepOfItsSpace(scene_, scheme) && cellsOf(scheme, scene_) > 0;
}

void Sweep::addLadder(std::size_t scheme) {
    const ResolvedScheme& own = scene_.schemes[scheme];
    const bool isRefined = refinesMesh(own);
    for (const double value : ladderOf(options_.ladder, scene_, own, isRefined)) {
        StudyPoint point;
        point.scheme = scheme;
        if (isRefined) {
            constexpr double fewest = 4;
            const int given = cellsOf(own, scene_);
            const int cells =
                static_cast<int>(std::max(fewest, std::round(given * own.spec.step.value / value)));
            if (cells != given) point.reduction.cells = cells;
        }
        if (own.isAdaptive()) {
            point.tolerance = value;
            point.row = noRow;
        } else {
            point.step = value;
            const auto known = std::find(steps_.begin(), steps_.end(), value);
            point.row = static_cast<std::size_t>(known - steps_.begin());
            if (known == steps_.end()) steps_.push_back(value);
        }
        rows_.push_back({point, {}});
    }
}

const SweepRow& Sweep::answer(std::size_t rung) const {
    const auto cost = [&](const PointResult& r) {
        if (!r.isDone()) return HUGE_VAL;
        return options_.repeat == 0 ? workOf(r, 1) : r.cpuSeconds;
    };
    const SweepRow* best = &rows_[rung];
    for (std::size_t i = rung + 1; i < rows_.size(); ++i)
        if (cost(rows_[i].result) < cost(best->result)) best = &rows_[i];
    return rows_[rung].result.status == RunStatus::waiting ? rows_[rung] : *best;
}

bool Sweep::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const SweepRow& row) {
        return row.result.status == RunStatus::done || row.result.status == RunStatus::failed;
    });
}

void Sweep::run(const std::function<void(const ReferenceInfo&)>& onReference,
                const std::function<void(std::size_t, const PointResult&)>& onPoint,
                const std::stop_token& stop) {
    const std::vector<std::size_t> wanted = wantedPoints(rows_.size(), options_.shard, [&](std::size_t i) {
        return rows_[i].result.status != RunStatus::waiting;
    });
    if (!wanted.empty()) {
        progress_.begin();
        if (isSearch())
            runSearch(wanted, onReference, onPoint, stop);
        else
            runPoints(wanted, onReference, onPoint, stop);
    }
    if (!options_.rungs.empty() && isComplete() && !stop.stop_requested())
        terms_ = termCosts(scene_, metric(), stop);
}

void Sweep::runPoints(const std::vector<std::size_t>& wanted,
                      const std::function<void(const ReferenceInfo&)>& onReference,
                      const std::function<void(std::size_t, const PointResult&)>& onPoint,
                      const std::stop_token& stop) {
    MapReference reference;
    Reference scheme;  // what adaptive runs, whose nodes no table has, are compared with
    Metric metric = metrics_.front();
    if (metric.needsReference()) {
        progress_.setPreparing(true);
        reference = MapReference(scene_, steps_, stop);
        if (scene_.scene.reference.kind == ReferenceSpec::Kind::scheme) scheme = makeReference(scene_, stop);
        progress_.setPreparing(false);
        reference_ = scheme.make ? scheme.info : reference.info();
        if (stop.stop_requested()) return;
        if (const ExactSolution solution =
                scheme.make ? scheme.make() : reference.at(noRow, scene_, scene_.schemes.front());
            solution && !scene_.schemes.front().ownSystem)
            metric = sized(metric, scene_, solution);
        metricSize_ = metric.size();
        if (onReference) onReference(reference_);
    }
    const auto referenceOf = [&](const StudyPoint& point) -> ExactSolution {
        if (!metric.needsReference()) return {};
        if (point.reduction) return reference.at(point.row, scene_, schemeOf(scene_, point));
        const ResolvedScheme& run = scene_.schemes[point.scheme];
        if (point.step == 0 && scheme.make && !run.ownSystem) return scheme.make();
        return reference.at(point.row, scene_, run);
    };
    progress_.announce(secondsAhead(wanted, referenceOf, reference.isShared(), stop));
    const auto compute = [&](std::size_t i) {
        const StudyPoint& point = rows_[i].point;
        return runPoint(scene_, point, metric, referenceOf(point), options_.repeat, stop);
    };
    progress_.run(wanted, options_.threads, stop, compute, [&](std::size_t i, PointResult result) {
        rows_[i].result = std::move(result);
        if (onPoint) onPoint(i, rows_[i].result);
    });
}

/// Of the points of ladders, scheme by scheme, with the reference: once where it is shared, of the shortest
/// step, which asks for the most of it, else beside every run.
double Sweep::secondsAhead(const std::vector<std::size_t>& wanted, const PointReference& referenceOf,
                           bool isShared, const std::stop_token& stop) const {
    const double start = scene_.initial.t, length = timeSpan(scene_.scene).length();
    const auto secondsOfReference = [&](const StudyPoint& point) {
        try {
            const ExactSolution solution = referenceOf(point);
            if (!solution) return 0.0;
            const std::size_t width = initialOf(scene_, schemeOf(scene_, point)).x.size();
            return secondsOfSolution(solution, width, start, start + length, point.step, stop);
        } catch (const InvalidScene&) {
            return 0.0;  // there is no such mesh
        }
    };
    const auto pointAt = [&](std::size_t k) -> const StudyPoint& { return rows_[wanted[k]].point; };
    const auto secondsOf = [&](std::size_t k) {
        const StudyPoint& point = pointAt(k);
        PointResult at;
        at.step = point.step;
        at.tolerance = point.tolerance;
        at.reduction = point.reduction;
        try {
            const ResolvedScheme scheme = schemeAt(scene_, point.scheme, at);
            return secondsOfPoint(trialSeconds(scene_, scheme, stop), options_.repeat) +
                   (isShared ? 0 : secondsOfReference(point));
        } catch (const InvalidScene&) {
            return 0.0;  // there is no such mesh
        }
    };
    ExpectedTime time;
    time.addSeries(
        wanted.size(), [&](std::size_t a, std::size_t b) { return pointAt(a).scheme == pointAt(b).scheme; },
        secondsOf);
    const auto shortest = std::min_element(wanted.begin(), wanted.end(), [&](std::size_t a, std::size_t b) {
        const double stepA = rows_[a].point.step, stepB = rows_[b].point.step;
        return stepA > 0 && (stepB == 0 || stepA < stepB);
    });
    if (isShared && shortest != wanted.end()) time.add(secondsOfReference(rows_[*shortest].point));
    return time.onThreads(options_.threads);
}

void Sweep::runSearch(const std::vector<std::size_t>& wanted,
                      const std::function<void(const ReferenceInfo&)>& onReference,
                      const std::function<void(std::size_t, const PointResult&)>& onPoint,
                      const std::stop_token& stop) {
    constexpr double usualSeconds = 1, usualOfLadder = 4;
    const bool isLadder = !options_.rungs.empty();
    SearchReference reference;
    const bool isNeeded =
        std::any_of(metrics_.begin(), metrics_.end(), [](const Metric& m) { return m.needsReference(); });
    if (isNeeded) {
        progress_.setPreparing(true);
        reference = SearchReference(scene_, metrics_, stop);
        progress_.setPreparing(false);
        if (stop.stop_requested()) return;
        reference_ = reference.info();
    }
    std::vector<Metric> metrics = metrics_;
    for (Metric& metric : metrics) metric = reference.sized(metric, scene_);
    confirmation_ = reference.confirmed(metrics.front());
    cases_ = casesOf(stop);
    metricSize_ = metrics.front().size();
    if (isNeeded && onReference) onReference(reference_);
    if (stop.stop_requested()) return;
    std::vector<SearchedScheme> searched;
    for (const SweepRow& row : isLadder ? searched_ : rows_)
        searched.push_back({row.point, !isLadder && isOfScene(row.point.scheme)});
    const bool isCounted = options_.repeat == 0;
    const double seconds = options_.searchSeconds > 0 ? options_.searchSeconds
                           : isCounted                ? std::numeric_limits<double>::infinity()
                           : isLadder                 ? usualOfLadder
                                                      : usualSeconds;
    constexpr double closing = 0.2;  // the best are timed when the search is over
    if (std::isfinite(seconds)) progress_.announce((1 + closing) * seconds, true);
    const std::vector<Metric> sizedMetrics = metrics;
    CandidateSearch search(
        scene_, searched, std::move(metrics),
        [&](const StudyPoint& point) { return reference.of(scene_, point); }, reference_, isCounted, seconds,
        stop);
    search.judgeOver(cases_, options_.over.isMedian);
    search.setKnobs(options_.knobs);
    if (options_.mostBytes > 0) search.setMostBytes(options_.mostBytes);
    if (isLadder) return climb(search, wanted, onPoint, stop);
    std::vector<double> values;
    for (const Wish& wish : wishes()) values.push_back(wish.value);
    const std::string reason = unjudged(options_.wantedError);
    std::vector<PointResult> results =
        !reason.empty()       ? std::vector<PointResult>(rows_.size(), notJudged(reason))
        : options_.budget > 0 ? spend(searched, sizedMetrics, values, reference, seconds, stop)
                              : search.find(values, options_.repeat);
    progress_.run(
        wanted, 1, stop, [&](std::size_t i) { return std::move(results[i]); },
        [&](std::size_t i, PointResult result) {
            rows_[i].result = std::move(result);
            if (onPoint) onPoint(i, rows_[i].result);
        });
}

/// The smallest error that a budget buys, of every scheme. A wish is then a unit for its metric.
std::vector<PointResult> Sweep::spend(const std::vector<SearchedScheme>& schemes,
                                      const std::vector<Metric>& metrics, const std::vector<double>& wishes,
                                      const SearchReference& reference, double seconds,
                                      const std::stop_token& stop) const {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    std::vector<StudyPoint> points;
    for (const SearchedScheme& each : schemes) points.push_back(each.point);
    const double length = timeSpan(scene_.scene).length();
    return bestWithin({scene_, points, metrics, wishes,
                       [&](const StudyPoint& point) { return reference.of(scene_.schemes[point.scheme]); },
                       reference_.estimatedError, options_.budget * (options_.isPerTime ? length : 1),
                       seconds, options_.mostBytes > 0 ? options_.mostBytes : unlimited, options_.repeat},
                      stop);
}

Sweep::ErrorRange Sweep::judgedErrors() const {
    constexpr double likeTheMotion = 0.2;
    return {metric().needsSizes() ? 0 : metric().floorBy(reference_.estimatedError),
            likeTheMotion * metricSize_};
}

/// Only where the two methods part altogether: by a thousandth of the motion, as they do where it is chaotic.
/// A smaller difference may be the error of the other method as well.
std::string Sweep::unjudged(double wish) const {
    const bool isMissing =
        std::any_of(metrics_.begin(), metrics_.end(), [](const Metric& m) { return m.needsReference(); }) &&
        reference_.type == "none" && !reference_.problems.empty();
    if (isMissing) return "there is no reference: " + reference_.problems.front().message;
    const bool isLost = !confirmation_ && reference_.estimatedError > std::max(wish, metricSize_);
    if (isLost)
        return "an error of " + formatNumber(wish, 2) +
               " cannot be judged: the reference may itself be off by " +
               formatNumber(reference_.estimatedError, 2) + ", as the motion forgets its start";
    if (cases_.empty()) return unjudgedIn(scene_, confirmation_, wish);
    for (const SearchCase& each : cases_)
        if (std::string why = unjudgedIn(*each.scene, each.confirmation, wish); !why.empty()) return why;
    return {};
}

std::string Sweep::unjudgedIn(const ResolvedScene& resolved, const Confirmation& confirmation,
                              double wish) const {
    constexpr double part = 1e-3;
    if (!confirmation || confirmation.bound() <= std::max(wish, part * metricSize_)) return {};
    const Scene& scene = resolved.scene;
    return "an error of " + formatNumber(wish, 2) +
           " can be judged to t = " + formatNumber(confirmation.judgedTo(wish), 3) + " of " +
           formatNumber(scene.end.value, 3) + ": there the reference and " + confirmation.by + " part, by " +
           formatNumber(confirmation.bound(), 2) + " at the end";
}

std::vector<SearchCase> Sweep::casesOf(const std::stop_token& stop) const {
    std::vector<SearchCase> cases;
    for (const auto& scene : caseScenes_) {
        if (stop.stop_requested()) break;
        SearchCase each{scene, metrics_, {}, {}};
        if (std::any_of(metrics_.begin(), metrics_.end(), [](const Metric& m) { return m.needsReference(); }))
            each.reference = SearchReference(*scene, metrics_, stop);
        for (Metric& metric : each.metrics) metric = each.reference.sized(metric, *scene);
        each.confirmation = each.reference.confirmed(each.metrics.front());
        cases.push_back(std::move(each));
    }
    return cases;
}

/// From the largest wish down: the runs for one are known to the next.
void Sweep::climb(CandidateSearch& search, const std::vector<std::size_t>& wanted,
                  const std::function<void(std::size_t, const PointResult&)>& onPoint,
                  const std::stop_token& stop) {
    progress_.run(
        wanted, 1, stop,
        [&](std::size_t i) {
            if (const std::string reason = unjudged(options_.rungs[i]); !reason.empty())
                return notJudged(reason);
            auto [index, result] = search.cheapest({&options_.rungs[i], 1}, options_.repeat);
            result.scheme = searched_[index].point.scheme;
            return result;
        },
        [&](std::size_t i, PointResult result) {
            take(i, std::move(result));
            if (onPoint) onPoint(i, rows_[i].result);
        });
}

bool areMeshesRefined(std::span<const SweepRow> rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [](const SweepRow& row) { return row.point.reduction.cells > 0; });
}

int cellsAt(const Sweep& sweep, const StudyPoint& point) {
    if (point.reduction.cells > 0) return point.reduction.cells;
    return cellsOf(sweep.scene().schemes[point.scheme], sweep.scene());
}

std::vector<SchemeRows> bySchemes(const Sweep& sweep) {
    std::vector<SchemeRows> all;
    const std::vector<SweepRow>& rows = sweep.rows();
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last < rows.size() && rows[last].point.scheme == rows[first].point.scheme) ++last;
        all.push_back({rows[first].point.scheme, std::span(rows).subspan(first, last - first)});
        first = last;
    }
    return all;
}

}  // namespace extremal
