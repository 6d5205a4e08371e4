// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/budget_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/bind.hpp"
#include "engine/study/search/excess.hpp"
#include "engine/study/search/ladder.hpp"

namespace extremal {
namespace {

/// Runs of one candidate.
class OneBudget {
public:
    OneBudget(const BudgetSearch& search, ProcessorWatch& watch, const StudyPoint& own,
              const std::stop_token& stop)
        : search_(search),
          watch_(watch),
          own_(own),
          scheme_(search.scene.schemes[own.scheme]),
          length_(timeSpan(search.scene.scene).length()),
          stop_(stop) {}

    PointResult find() {
        if (hasStepOfItsSpace(search_.scene, scheme_))
            (void)run(std::max(1.0, std::round(length_ / own_.step)));
        else
            climb();
        return best_ ? *best_ : failure_;
    }

private:
    /// n steps, or a tolerance of 1/n; its cost in budgets, or nothing where it failed.
    std::optional<double> run(double n) {
        constexpr double least = 2e-5;
        StudyPoint point = own_;
        if (scheme_.isAdaptive())
            point.tolerance = 1 / n;
        else if (!hasStepOfItsSpace(search_.scene, scheme_))
            point.step = length_ / n;
        const CostLimit limit{
            .seconds = cutOff * search_.budget + least, .bytes = search_.bytes, .watch = &watch_};
        PointResult result =
            runPoint(search_.scene, point, search_.metrics, search_.reference(own_), 0, limit, stop_);
        if (result.isCutOff) {
            failure_.status = RunStatus::failed;
            if (failure_.reason.empty()) failure_.reason = "dearer than the budget";
            const double part = result.steps > 0 && !scheme_.isAdaptive()
                                    ? static_cast<double>(result.steps) / n
                                    : 1 / cutOff;
            return result.cpuSeconds / (search_.budget * std::max(part, 1e-3));
        }
        if (!result.isDone()) {
            failure_ = result;
            failure_.status = RunStatus::failed;
            if (failure_.reason.empty())
                failure_.reason =
                    "no run without failure within the budget: " + std::string(name(result.cause));
            return {};
        }
        const double cost = result.cpuSeconds / search_.budget;
        result.excess = excessOf(result, search_.metrics, search_.wishes, search_.referenceError);
        constexpr double slack = 1.02;
        if (cost <= slack && std::isfinite(result.excess) && (!best_ || isNearer(result, *best_)))
            best_ = result;
        if (cost > slack && failure_.reason.empty()) {
            failure_.status = RunStatus::failed;
            failure_.reason = "dearer than the budget";
        }
        return cost;
    }

    /// Of n: as few steps tell, or of tolerances a usual one.
    double firstGuess() const {
        constexpr long long few = 5;
        if (scheme_.isAdaptive()) return 1e6;
        double n = 32;
        for (int i = 0; i < 2; ++i) {
            StudyPoint point = own_;
            point.step = length_ / n;
            const StepCost cost = tryPoint(search_.scene, point, few,
                                           {.seconds = cutOff * search_.budget, .watch = &watch_}, stop_);
            if (!(cost.seconds > 0)) return n;
            n = std::clamp(std::floor(search_.budget / cost.seconds), 2.0, 1e7);
        }
        return n;
    }

    void climb() {
        constexpr int most = 7;
        constexpr double enough = 0.8, most1 = 1.02;
        const double leastN = scheme_.isAdaptive() ? 10 : 2, mostN = scheme_.isAdaptive() ? 1e15 : 1e7;
        // The cost grows like n, that of tolerances like n^(1/order).
        const double power = scheme_.isAdaptive() ? std::max(1, scheme_.claims.order) : 1;
        double n = firstGuess(), low = 0, high = HUGE_VAL;
        for (int i = 0; i < most && !stop_.stop_requested(); ++i) {
            const std::optional<double> cost = run(n);
            double next = 2 * n;  // a failure: shorter steps
            if (cost) {
                if (*cost >= enough && *cost <= most1) break;
                (*cost > most1 ? high : low) = n;
                next = n * std::clamp(std::pow(0.93 / *cost, power), 1e-3, 1e3);
            } else {
                low = n;
            }
            if (next >= high || next <= low)
                next = std::isfinite(high) ? std::sqrt(std::max(low, 1.0) * high) : 2 * low;
            next = std::clamp(next, leastN, mostN);
            if (!scheme_.isAdaptive()) next = std::round(next);
            if (next == n) break;
            n = next;
        }
        if (!best_) return;
        const double found = scheme_.isAdaptive() ? 1 / best_->tolerance : static_cast<double>(best_->steps);
        for (const double part : {2.0, 5.0}) {
            const double fewer = scheme_.isAdaptive() ? found / std::pow(part, 2) : std::round(found / part);
            if (fewer >= leastN) (void)run(fewer);
        }
    }

    static constexpr double cutOff = 3;  ///< budgets that a run may cost until it is given up

    const BudgetSearch& search_;
    ProcessorWatch& watch_;
    StudyPoint own_;
    const ResolvedScheme& scheme_;
    double length_;
    std::stop_token stop_;
    std::optional<PointResult> best_;
    PointResult failure_;
};

/// "the least error"; "7.3 times the least error".
void rank(std::vector<PointResult>& results) {
    double least = HUGE_VAL;
    for (const PointResult& r : results)
        if (r.isDone()) least = std::min(least, r.excess);
    for (PointResult& r : results)
        if (r.isDone())
            r.reason = r.excess > least
                           ? formatNumber(std::exp(r.excess - least), 3) + " times the least error"
                           : "the least error";
}

}  // namespace

std::vector<PointResult> bestWithin(const BudgetSearch& search, const std::stop_token& stop) {
    constexpr std::size_t timed = 3;
    constexpr double longest = 0.1;
    const double begin = threadSeconds();
    ProcessorWatch watch;
    std::vector<PointResult> results;
    for (const StudyPoint& own : search.candidates) {
        if (stop.stop_requested()) return results;
        if (threadSeconds() - begin > search.seconds) {
            PointResult late;
            late.status = RunStatus::failed;
            late.reason = "the search ended after " + formatNumber(search.seconds, 2) + " s";
            results.push_back(std::move(late));
            continue;
        }
        results.push_back(OneBudget(search, watch, own, stop).find());
        if (results.back().status == RunStatus::waiting) results.back().status = RunStatus::failed;
    }
    rank(results);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < results.size(); ++i)
        if (results[i].isDone()) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return isNearer(results[a], results[b]); });
    for (std::size_t place = 0; place < std::min(timed, order.size()) && !stop.stop_requested(); ++place) {
        PointResult& r = results[order[place]];
        StudyPoint at = search.candidates[order[place]];
        at.step = r.step;
        at.tolerance = r.tolerance;
        const int times =
            static_cast<int>(std::min<double>(search.repeat, longest / std::max(r.cpuSeconds, 1e-9)));
        if (times <= 0) continue;
        const PointResult again =
            runPoint(search.scene, at, search.metrics, search.reference(at), times, {}, stop);
        r.cpuSeconds = again.cpuSeconds;
        r.cpuSpread = again.cpuSpread;
    }
    return results;
}

}  // namespace extremal
