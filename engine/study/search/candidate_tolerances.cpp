// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a search that solves the equations of a step less exactly.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/study/search/candidate_search.hpp"

namespace extremal {

/// From a hundredth of the wish on, in relation to the size of what is wished for: a hundred times looser
/// while that is cheaper and the wishes hold, or else tighter until they do.
void CandidateSearch::loosen(std::size_t index, std::span<const double> wishes, PointResult& result) {
    constexpr double part = 1e-2, worthIt = 0.95;
    constexpr int fewest = 2, most = 13, step = 2, times = 3;  // digits of the tolerance
    if (!schemeOf(index).family || result.tolerance > 0) return;
    double relative = HUGE_VAL;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        const double size = metrics_[i].size();
        relative = std::min(relative, wishes[i] / (std::isfinite(size) && size > 0 ? size : 1));
    }
    StudyPoint own = schemes_[index].point;
    own.reduction = result.reduction;
    const PointResult exact = result;
    const auto runAt = [&](double tolerance) {
        StudyPoint at = own;
        at.step = exact.step;
        at.reduction.solver = tolerance;
        const double begin = threadSeconds();
        PointResult made;
        try {
            (void)extremal::schemeOf(scene_, at);  // refused where there is no such scheme
            made = runCases(at, at, isCounted_ ? 0 : times, {.watch = &watch_}, {});
        } catch (const InvalidScene&) {
            made.status = RunStatus::failed;
        }
        spent_ += threadSeconds() - begin;
        made.reduction = at.reduction;
        made.excess = excessOf(made, wishes);
        return made;
    };
    PointResult best = isCounted_ ? exact : runAt(0);
    const double known = costOf(own, best);
    double least = worthIt * known;
    const auto isBetter = [&](const PointResult& r) {
        return r.isDone() && r.excess <= 0 && costOf(own, r) < least;
    };
    const int first = std::clamp(static_cast<int>(std::ceil(-std::log10(part * relative))), fewest, most);
    bool isFound = false;
    for (int digits = first; digits >= fewest && !isTimeUp(); digits -= step) {
        PointResult r = runAt(std::pow(10.0, -digits));
        if (!isBetter(r)) break;
        least = costOf(own, r);
        best = std::move(r);
        isFound = true;
    }
    for (int digits = first + step; digits <= most && !isFound && !isTimeUp(); digits += step) {
        PointResult r = runAt(std::pow(10.0, -digits));
        isFound = isBetter(r);
        if (isFound) best = std::move(r);
    }
    if (!isFound) return;
    best.unreducedWork = exact.unreducedWork;
    best.confirmedAt = exact.confirmedAt;
    best.tried = exact.tried;
    best.reason = exact.reason + "; its equations solved to " + formatNumber(best.reduction.solver, 1) +
                  " only, " + timesDearer(known / costOf(own, best)) + " otherwise" +
                  structureWithout(index, exact, best);
    result = std::move(best);
}

/// What is kept less well for that: ", for momentum kept to 3e-09 in place of 2e-15"; empty: nothing is
/// known.
std::string CandidateSearch::structureWithout(std::size_t index, const PointResult& exact,
                                              const PointResult& loose) const {
    const auto keptTo = [&](const Metric& metric, const PointResult& r) {
        StudyPoint at = schemes_[index].point;
        at.step = r.step;
        at.reduction = r.reduction;
        const PointResult run = runPoint(scene_, at, metric, {}, 0, stop_);
        return run.isDone() ? run.error : PointResult::unknown;
    };
    for (const std::string& name : schemeOf(index).claims.conserves) {
        try {
            const Metric metric = metricOf(name, false, *scene_.system, scene_.initial);
            if (metric.needsReference()) continue;
            const double without = keptTo(metric, loose), with = keptTo(metric, exact);
            if (!(without > 0)) continue;
            return ", for " + name + " kept to " + formatNumber(without, 1) + " in place of " +
                   formatNumber(with, 1);
        } catch (const InvalidScene&) {
            continue;  // of another system
        }
    }
    return {};
}

}  // namespace extremal
