// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/candidate_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/study/model_in_place.hpp"
#include "engine/study/search/excess.hpp"
#include "engine/study/search/ladder.hpp"

namespace extremal {

std::string CandidateSearch::timesDearer(double times) {
    return formatNumber(times, times < 10 ? 2 : 3) + " times dearer";
}

CandidateSearch::CandidateSearch(const ResolvedScene& scene, std::vector<SearchedScheme> schemes,
                                 std::vector<Metric> metrics, References references, ReferenceInfo reference,
                                 bool isCounted, double seconds, const std::stop_token& stop)
    : scene_(scene),
      schemes_(std::move(schemes)),
      metrics_(std::move(metrics)),
      references_(std::move(references)),
      reference_(std::move(reference)),
      isCounted_(isCounted),
      seconds_(seconds),
      length_(timeSpan(scene.scene).length()),
      stop_(stop),
      entries_(schemes_.size()) {}

StudyPoint CandidateSearch::pointAt(const StudyPoint& own, const ResolvedScheme& scheme, double n) const {
    StudyPoint point = own;
    if (scheme.isAdaptive()) {
        point.tolerance = 1 / n;
    } else if (const double factor = stepFactorOf(scheme, scene_); factor > 0) {
        const double given = std::round(length_ / own.step);
        if (n == given) return point;
        point.reduction.stepFactor = factor * given / n;
        point.step = own.step * given / n;
    } else if (!hasStepOfItsSpace(scene_, scheme)) {
        point.step = length_ / n;
    }
    return point;
}

double CandidateSearch::excessOf(const PointResult& result, std::span<const double> wishes) const {
    return extremal::excessOf(result, metrics_, wishes, reference_.estimatedError);
}

/// An error as large as a fifth of the motion says nothing of the order.
bool CandidateSearch::isSaturated(const PointResult& result) const {
    constexpr double part = 0.2;
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
        const double value = result.errorIn(i);
        if (value > part * metrics_[i].size()) return true;
    }
    return false;
}

/// A few steps at each of several lengths: a step that is too long for its equations costs more than shorter
/// ones do, and where it has no solution it costs most of all. Once that has taken a quarter of the time,
/// lengths of no use to several schemes in a row are left out, and shorter steps tried in their place.
void CandidateSearch::findStart(const StudyPoint& own, const ResolvedScheme& scheme, RaceEntry& entry) {
    constexpr long long steps = 3;
    constexpr int enough = 3;
    constexpr double part = 0.01, untimed = 1;
    const double longest = std::isfinite(seconds_) ? part * seconds_ : untimed;
    if (scheme.isAdaptive()) {
        // Its first steps tell nothing of the others, which may be much longer.
        entry.firstN = 10;
        return;
    }
    const bool isPressed = spent_ > seconds_ / 4;
    constexpr double tooMuchWork = 1e6;
    double least = HUGE_VAL, cutOff = 0;
    constexpr std::size_t usual = 3;
    const auto wholeRun = [&](double n) {
        const StepCost cost =
            tryPoint(scene_, pointAt(own, scheme, n), steps, {.seconds = longest, .watch = &watch_}, stop_);
        if (cost.isCutOff) cutOff = isCounted_ ? tooMuchWork : longest;
        const double whole = n * (isCounted_ ? cost.work : cost.seconds);
        if (whole < least) {
            least = whole;
            entry.firstN = n;
        }
        return whole;
    };
    for (std::size_t i = 0; i < (isPressed ? std::size(trialLengths) : usual); ++i) {
        if (i >= usual && std::isfinite(least)) break;
        if (isPressed && useless_[i] >= enough) continue;
        const double n = trialLengths[i], whole = wholeRun(n);
        useless_[i] = std::isfinite(whole) ? 0 : useless_[i] + 1;
        if (std::isfinite(whole)) entry.trials.emplace_back(n, whole);
        if (std::isfinite(least) && whole > 3 * least) break;  // as long as steps cost the same, n decides
    }
    // Where longer steps cost more, the best may be between.
    if (std::isfinite(least) && entry.firstN > trialLengths[0]) {
        const double n = entry.firstN / 2, whole = wholeRun(n);
        if (std::isfinite(whole)) entry.trials.emplace_back(n, whole);
        std::sort(entry.trials.begin(), entry.trials.end());
    }
    entry.firstCost = std::isfinite(least) ? least : cutOff;
}

RaceEntry CandidateSearch::entryFor(const StudyPoint& own, const ResolvedScheme& scheme) {
    RaceEntry entry;
    entry.isAdaptive = scheme.isAdaptive();
    entry.order = entry.isAdaptive ? 1 : scheme.claims.order > 0 ? scheme.claims.order : 2;
    const bool isOfSpace = hasStepOfItsSpace(scene_, scheme);
    entry.isSingle = isOfSpace && (!knobs_.isStepFactor || stepFactorOf(scheme, scene_) == 0);
    entry.hasOtherKnob = knobs_.isCells && !entry.isSingle && cellsOf(scheme, scene_) > 0;
    if (isOfSpace)
        entry.firstN = std::max(1.0, std::round(length_ / own.step));
    else if (!entry.hasOtherKnob)
        findStart(own, scheme, entry);
    return entry;
}

RaceRun CandidateSearch::runOf(const StudyPoint& own, const ResolvedScheme& scheme, const RaceJob& job,
                               std::span<const double> wishes) {
    const Key key = keyOf(own, job.n);
    auto known = known_.find(key);
    if (known == known_.end() || (known->second.result.isCutOff && known->second.cost < job.limit)) {
        // Before anyone has reached the wish, a run that goes wrong must not take all the time there is.
        constexpr double tooLong = 16, fewSeconds = 1e-3, littleWork = 1e4;
        CostLimit limit{.bytes = mostBytes_, .watch = &watch_};
        (isCounted_ ? limit.work : limit.seconds) =
            std::min(job.limit, tooLong * job.predictedCost + (isCounted_ ? littleWork : fewSeconds));
        if (isCounted_) limit.work /= unknownsOf(own);
        const double left = std::isfinite(seconds_) ? std::max(seconds_ - spent_, fewSeconds) : longestStep;
        limit.seconds = std::min(limit.seconds, left);
        Known made;
        made.result = runCases(own, pointAt(own, scheme, job.n), 0, limit, wishes);
        made.cost = costOf(own, made.result);
        // A step that did not end is counted nowhere.
        if (made.result.isCutOff)
            made.cost = std::max(made.cost, isCounted_ ? limit.work * unknownsOf(own) : limit.seconds);
        ++runs_;
        known = known_.insert_or_assign(key, std::move(made)).first;
    }
    const auto& [result, cost] = known->second;
    RaceRun run{job.n, excessOf(result, wishes), cost, false, result.isCutOff, false};
    run.isSaturated = run.excess > 0 && isSaturated(result);
    // A Courant number may be too large; everything else is refused whatever the step.
    run.isAtFloor = result.cause == Outcome::refused && result.reduction.stepFactor == 0;
    for (std::size_t i = 0; i < wishes.size() && run.excess > 0 && result.isDone(); ++i) {
        const double value = result.errorIn(i);
        run.isAtFloor = run.isAtFloor || (value > wishes[i] && value <= floorOf(i));
    }
    return run;
}

/// A run on each case; `limit` is one of their mean.
PointResult CandidateSearch::runCases(const StudyPoint& own, const StudyPoint& at, int repeat,
                                      const CostLimit& limit, std::span<const double> wishes) {
    if (cases_.empty()) return runPoint(scene_, at, metrics_, references_(own), repeat, limit, stop_);
    const auto count = static_cast<double>(cases_.size());
    CostLimit left{limit.seconds * count, limit.work * count, limit.bytes, limit.watch};
    std::vector<PointResult> results;
    for (std::size_t i = 0; i < cases_.size() && !stop_.stop_requested(); ++i) {
        const SearchCase& each = cases_[i];
        const ResolvedScheme& scheme = each.scene->schemes[own.scheme];
        results.push_back(
            runPoint(*each.scene, at, each.metrics, each.reference.of(*each.scene, at), repeat, left, stop_));
        left.seconds -= results.back().cpuSeconds;
        left.work -= workOf(results.back(), richnessOf(scheme).nodes);
        if (isMedian_ || repeat > 0 || !(excessOf(results.back(), wishes) > 0)) continue;
        std::rotate(cases_.begin(), cases_.begin() + static_cast<std::ptrdiff_t>(i),
                    cases_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        break;
    }
    return combined(results, isMedian_);
}

/// Until so much has been spent.
void CandidateSearch::drive(CandidateRace& race, double seconds,
                            const std::function<RaceRun(const RaceJob&)>& run) {
    while (!stop_.stop_requested() && spent_ < seconds) {
        const double begin = threadSeconds();
        const std::optional<RaceJob> job = race.next();
        if (!job) return;
        race.take(*job, run(*job));
        spent_ += threadSeconds() - begin;
    }
}

const PointResult& CandidateSearch::knownAt(const StudyPoint& point, double n) const {
    return known_.at(keyOf(point, n)).result;
}

/// A model that leaves something out of the system.
bool CandidateSearch::isReduced(std::size_t index) const {
    return !modelInPlace(schemeOf(index), *scene_.system).empty();
}

/// Its name, where an error that does not fall has reached one.
void CandidateSearch::nameFloor(std::size_t index, PointResult& result) const {
    const ResolvedScheme& scheme = schemeOf(index);
    const double seen = floorOf(0);
    result.floor = result.error;
    constexpr double roundOff = 2.2e-15;
    if (result.error <= seen)
        result.floorOf = "reference", result.floor = seen;
    else if (isReduced(index))
        result.floorOf = "model";
    else if (scheme.orderInSpace() > 0)
        result.floorOf = "mesh";
    else if (result.error < roundOff * metrics_[0].size() * static_cast<double>(std::max(1LL, result.steps)))
        result.floorOf = "round-off";
}

std::string CandidateSearch::reasonOf(const CandidateRace& race, std::size_t index,
                                      const PointResult& nearest) const {
    const std::vector<RaceRun>& runs = race.runsOf(index);
    if (!entries_[index] && runs.empty()) return "not tried: trials of others took a third of the time";
    switch (race.endOf(index)) {
        case RaceEnd::reached:
            return "reached at single steps only: a finer one fails";
        case RaceEnd::dearer: {
            if (nearest.floorOf == "model") return "ends at " + formatNumber(nearest.error, 2) + " (model)";
            if (!(race.predictedN(index) > 0)) return "would be dearer than the cheapest";
            const double times = nearest.timesCheapest;
            const std::string needs =
                schemeOf(index).isAdaptive()
                    ? "would need a tolerance of about " + formatNumber(1 / race.predictedN(index), 2)
                    : "would need about " + formatNumber(race.predictedN(index), 2) + " steps";
            return needs + (times > 0 ? ", " + timesDearer(times) : "");
        }
        case RaceEnd::cutOff:
            return "first run dearer than the answer";
        case RaceEnd::failing: {
            if (runs.empty() || std::isfinite(runs.back().excess))
                return "no run below the best cost has an error smaller than the motion";
            const PointResult& last = knownAt(schemes_[index].point, runs.back().n);
            return "no run without failure below the best cost: " + std::string(name(last.cause));
        }
        case RaceEnd::stalled:
            if (nearest.floorOf.empty())
                return "its error stays at " + formatNumber(nearest.error, 2) + " below the best cost";
            [[fallthrough]];
        case RaceEnd::atFloor:
            if (nearest.cause == Outcome::refused) return "refused: " + nearest.reason;
            return "ends at " +
                   formatNumber(nearest.floorOf == "reference" ? nearest.floor : nearest.error, 2) +
                   (nearest.floorOf.empty() ? "" : " (" + nearest.floorOf + ")");
        case RaceEnd::exhausted:
            if (runs.empty()) return "not searched";
            return schemeOf(index).isAdaptive()
                       ? "does not reach it down to a tolerance of " + formatNumber(1 / runs.back().n, 2)
                       : "does not reach it within " + formatNumber(runs.back().n, 2) + " steps";
        case RaceEnd::open:
            break;
    }
    return isTimeUp() ? "the search ended after " + formatNumber(seconds_, 2) + " s" : "not searched";
}

/// `least`: the cost of the cheapest of all.
PointResult CandidateSearch::resultOf(const CandidateRace& race, std::size_t index, double least) const {
    const StudyPoint& point = schemes_[index].point;
    const std::vector<RaceRun>& runs = race.runsOf(index);
    if (const auto best = race.bestOf(index)) {
        const RaceRun& run = runs[*best];
        PointResult result = knownAt(point, run.n);
        result.excess = run.excess;
        const double confirmed = race.confirmedAt(index);
        if (confirmed > 0)
            result.confirmedAt = schemeOf(index).isAdaptive() ? 1 / confirmed : length_ / confirmed;
        result.reason = run.cost > least ? "reached, " + timesDearer(run.cost / least) : "the cheapest";
        return result;
    }
    // The nearest run to its end; else any that says how it failed.
    const auto nearest = std::min_element(
        runs.begin(), runs.end(), [](const RaceRun& a, const RaceRun& b) { return a.excess < b.excess; });
    PointResult result;
    if (nearest != runs.end()) result = knownAt(point, nearest->n);
    result.excess = nearest != runs.end() ? nearest->excess : PointResult::unknown;
    result.status = RunStatus::failed;
    if (race.predictedCost(index) > 0 && std::isfinite(least))
        result.timesCheapest = race.predictedCost(index) / least;
    // Errors of a model that no longer fall are its own, whatever its order promises.
    constexpr double flat = 0.1;
    const bool isFlat = runs.size() > 1 && std::abs(runs.back().excess - runs[runs.size() - 2].excess) < flat,
               isModel = isReduced(index) && (race.endOf(index) == RaceEnd::stalled ||
                                              (race.endOf(index) == RaceEnd::dearer && isFlat));
    if ((race.endOf(index) == RaceEnd::atFloor || isModel) && result.cause != Outcome::refused)
        nameFloor(index, result);
    result.reason = reasonOf(race, index, result);
    return result;
}

/// From few steps to many; of schemes on meshes in the order in which they were made.
std::vector<TriedRun> CandidateSearch::triedBy(std::size_t index) const {
    std::vector<TriedRun> all;
    if (const auto mesh = meshes_.find(index); mesh != meshes_.end()) {
        for (const MeshRun& run : mesh->second.runs())
            if (std::isfinite(run.error)) all.push_back({run.cost, run.error, run.steps, run.cells});
        return all;
    }
    for (const auto& [key, known] : known_) {
        const PointResult& r = known.result;
        const auto& [scheme, degree, nodes, cells, smaller, n] = key;
        const bool isWhole = degree == 0 && cells == 0 && smaller == 0;
        if (scheme != schemes_[index].point.scheme || !isWhole) continue;
        if (!r.isDone()) continue;  // what failed early cost little, and shows no error
        all.push_back({costOf(schemes_[index].point, r), r.errorIn(0), n, 0});
    }
    return all;
}

void CandidateSearch::timeOne(std::size_t index, PointResult& r, int repeat) {
    StudyPoint at = schemes_[index].point;
    at.step = r.step;
    at.tolerance = r.tolerance;
    at.reduction = r.reduction;
    // A run that takes long is timed by itself: repetitions would take longer than the search.
    constexpr double longest = 0.1;
    const int times = static_cast<int>(std::min<double>(repeat, longest / std::max(r.cpuSeconds, 1e-9)));
    if (times > 0) {
        const PointResult timed = runCases(at, at, times, {}, {});
        r.cpuSeconds = timed.cpuSeconds;
        r.cpuSpread = timed.cpuSpread;
    }
    r.predictedSeconds = predictSeconds(scene_, schemeAt(scene_, at.scheme, r));
}

/// Those of the scene, and the best three of all.
void CandidateSearch::time(std::vector<PointResult>& results, int repeat) {
    constexpr std::size_t most = 3;
    std::vector<std::size_t> reached;
    for (std::size_t i = 0; i < results.size(); ++i)
        if (results[i].isDone()) reached.push_back(i);
    std::sort(reached.begin(), reached.end(),
              [&](std::size_t a, std::size_t b) { return results[a].cpuSeconds < results[b].cpuSeconds; });
    for (std::size_t place = 0; place < reached.size() && !stop_.stop_requested(); ++place)
        if (place < most || schemes_[reached[place]].isOfScene)
            timeOne(reached[place], results[reached[place]], repeat);
}

/// The scene's own, then what is cheap to try: codes without equations to solve, low degrees. Compositions
/// and steps that follow a monitor come last.
std::vector<std::size_t> CandidateSearch::orderOfTrials() const {
    std::vector<std::size_t> order(schemes_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto rank = [&](std::size_t i) {
        const ResolvedScheme& scheme = schemeOf(i);
        if (schemes_[i].isOfScene || (knobs_.isCells && cellsOf(scheme, scene_) > 0)) return -1;
        // What has no second derivative of its own, and what takes several steps in place of one.
        constexpr int composed = 20, monitored = 40;
        if (scheme.isMonitored()) return monitored;
        if (scheme.isComposed()) return composed + scheme.claims.order;
        return scheme.family ? 1 + std::max(scheme.claims.order, 0) : 0;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    return order;
}

CandidateRace CandidateSearch::raceFor(std::span<const double> wishes) {
    // Most of the time belongs to the race.
    constexpr double partOfTrials = 0.35;
    for (const std::size_t i : orderOfTrials()) {
        if (entries_[i] || stop_.stop_requested()) continue;
        if (!schemes_[i].isOfScene && spent_ > partOfTrials * seconds_) break;
        const double begin = threadSeconds();
        entries_[i] = entryFor(schemes_[i].point, schemeOf(i));
        spent_ += threadSeconds() - begin;
    }
    std::vector<RaceEntry> entries;
    for (std::size_t i = 0; i < schemes_.size(); ++i) {
        constexpr double unknownCost = 1e300;
        entries.push_back(entries_[i] ? *entries_[i] : RaceEntry{.firstCost = unknownCost});
        entries.back().mostTimes = schemes_[i].isOfScene ? mostTimesTheLeast : 1;
    }
    CandidateRace race(entries);
    // What these find limits the race of those whose mesh is that of the scene, which limits in turn what is
    // spent on a first run that would take long.
    constexpr double partOfMeshes = 0.7, longestFirst = 0.1;
    searchMeshes(race, wishes,
                 std::isfinite(seconds_) ? spent_ + partOfMeshes * (seconds_ - spent_) : seconds_,
                 longestFirst * seconds_);
    race.setKnownCost(leastCost(race, wishes));
    if (!stop_.stop_requested())
        drive(race, seconds_, [&](const RaceJob& job) {
            return runOf(schemes_[job.entry].point, schemeOf(job.entry), job, wishes);
        });
    searchMeshes(race, wishes, seconds_, HUGE_VAL);
    return race;
}

std::vector<PointResult> CandidateSearch::find(std::span<const double> wishes, int repeat) {
    std::vector<PointResult> results(schemes_.size());
    const CandidateRace race = raceFor(wishes);
    if (stop_.stop_requested()) return results;
    for (std::size_t i = 0; i < schemes_.size(); ++i) results[i] = fullResultOf(race, i, wishes);
    for (std::size_t i = 0; i < schemes_.size(); ++i)
        if (schemes_[i].isOfScene && results[i].isDone() && !entries_[i]->isSingle &&
            !entries_[i]->isAdaptive)
            reduce(i, wishes, results[i]);
    for (std::size_t i = 0; i < schemes_.size() && knobs_.isTolerance; ++i)
        if (results[i].isDone() && (schemes_[i].isOfScene || results[i].reason.starts_with("the cheapest")))
            loosen(i, wishes, results[i]);
    time(results, repeat);
    return results;
}

std::pair<std::size_t, PointResult> CandidateSearch::cheapest(std::span<const double> wishes, int repeat) {
    const CandidateRace race = raceFor(wishes);
    if (stop_.stop_requested()) return {};
    std::pair<std::size_t, PointResult> best{0, fullResultOf(race, 0, wishes)};
    const auto isBetter = [](const PointResult& a, const PointResult& b) {
        if (a.isDone() != b.isDone()) return a.isDone();
        if (a.isDone()) return a.reason.starts_with("the cheapest");
        return a.excess < b.excess || std::isnan(b.excess);
    };
    for (std::size_t i = 1; i < schemes_.size(); ++i)
        if (PointResult r = fullResultOf(race, i, wishes); isBetter(r, best.second)) best = {i, std::move(r)};
    if (best.second.isDone()) timeOne(best.first, best.second, repeat);
    return best;
}

}  // namespace extremal
