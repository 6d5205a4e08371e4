// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/study/search/ladder.hpp"

namespace extremal {
namespace {

constexpr double strictest = 1e15;  ///< 1/tolerance
constexpr int mostRuns = 24;

class Search {
public:
    Search(const ResolvedScene& scene, const ResolvedScheme& scheme, const StudyPoint& own, double wanted,
           double most, const std::function<PointResult(const StudyPoint&, int)>& run)
        : own_(own),
          wanted_(wanted),
          mostSteps_(most),
          isAdaptive_(scheme.isAdaptive()),
          isOnly_(hasStepOfItsSpace(scene, scheme)),
          length_(scene.scene.end.value - scene.scene.start.value),
          order_(isAdaptive_ ? 1 : std::max(1, scheme.claims.order)),
          run_(run) {}

    PointResult find() {
        if (isOnly_) {
            PointResult result = run_(own_, 0);
            if (result.isDone() && !(result.error <= wanted_)) result.status = RunStatus::failed;
            return result;
        }
        double n = isAdaptive_ ? 1 / own_.tolerance : std::max(1.0, std::round(length_ / own_.step));
        PointResult found;
        for (int runs = 0; runs < mostRuns; ++runs) {
            const PointResult result = run_(at(n), 0);
            if (result.status == RunStatus::partial) return result;
            const bool isKnown = result.isDone() && std::isfinite(result.error);
            if (isKnown && !(nearest_ && nearest_->error <= result.error)) nearest_ = result;
            const double excess = isKnown ? std::log(result.error / wanted_) : HUGE_VAL;
            if (excess <= 0) {
                good_ = End{n, excess};
                found = result;
            } else {
                noteBad(n, excess);
            }
            const std::optional<double> next = nextOf();
            if (!next) break;
            n = *next;
        }
        if (good_) return found;
        PointResult failed = nearest_.value_or(PointResult{});
        failed.status = RunStatus::failed;
        return failed;
    }

private:
    struct End {
        double n, excess;  ///< excess: log(error / wanted)
    };

    StudyPoint at(double n) const {
        StudyPoint point = own_;
        if (isAdaptive_)
            point.tolerance = 1 / n;
        else
            point.step = length_ / n;
        return point;
    }
    void noteBad(double n, double excess) {
        // Errors that no longer fall although the steps have doubled: the floor of the scheme, or round-off.
        if (bad_ && n >= 1.9 * bad_->n && std::isfinite(excess) && excess > bad_->excess - 0.3) ++stalls_;
        bad_ = End{n, excess};
    }
    double rounded(double n) const { return isAdaptive_ ? n : std::round(n); }

    /// None where the search ends.
    std::optional<double> nextOf() const {
        const double apart = isAdaptive_ ? 1.2 : 1.03, limit = isAdaptive_ ? strictest : mostSteps_;
        if (good_ && bad_) {
            const double low = bad_->n, high = good_->n;
            if (high <= low * apart || (!isAdaptive_ && high - low <= 1)) return {};
            double part = 0.5;  // of the way from bad to good, on the logarithmic scale
            if (std::isfinite(bad_->excess) && std::isfinite(good_->excess))
                part = std::clamp(bad_->excess / (bad_->excess - good_->excess), 0.15, 0.9);
            const double n = rounded(low * std::pow(high / low, part));
            return isAdaptive_ ? n : std::clamp(n, low + 1, high - 1);
        }
        if (good_) {
            if (good_->n <= 1) return {};
            const double factor =
                std::isfinite(good_->excess) ? std::exp(good_->excess / order_) * 0.97 : 1.0 / 16;
            return std::max(1.0, std::min(rounded(good_->n * std::clamp(factor, 1.0 / 16, 0.97)),
                                          isAdaptive_ ? good_->n * 0.8 : good_->n - 1));
        }
        if (stalls_ >= 2 || bad_->n >= limit) return {};
        const double factor = std::isfinite(bad_->excess) ? std::exp(bad_->excess / order_) * 1.05 : 2;
        return std::min(limit, std::max(rounded(bad_->n * std::clamp(factor, 1.05, 16.0)), bad_->n + 1));
    }

    StudyPoint own_;
    double wanted_, mostSteps_;
    bool isAdaptive_;
    bool isOnly_;  ///< the step follows from the space: there is no other
    double length_;
    int order_;
    const std::function<PointResult(const StudyPoint&, int)>& run_;
    std::optional<End> good_, bad_;
    std::optional<PointResult> nearest_;
    int stalls_ = 0;
};

}  // namespace

PointResult searchPoint(const ResolvedScene& scene, const StudyPoint& own, double wanted, int repeat,
                        const std::function<PointResult(const StudyPoint&, int repeat)>& run,
                        double mostSteps) {
    const ResolvedScheme& scheme = scene.schemes[own.scheme];
    const PointResult whole = Search(scene, scheme, own, wanted, mostSteps, run).find();
    if (!whole.isDone()) return whole;
    const Reduction has = richnessOf(scheme);
    const double work = workOf(whole, has.nodes);
    PointResult best = whole;
    double least = work;
    for (const Reduction& reduction : reductionsOf(scheme, scene)) {
        StudyPoint less = own;
        less.reduction = reduction;
        less.step = whole.step;
        // With more steps it could not be cheaper, even if its nodes took half as many evaluations.
        const double perStep = work / static_cast<double>(whole.steps) * reduction.nodes / has.nodes;
        const PointResult result =
            Search(scene, schemeOf(scene, less), less, wanted, 2 * least / perStep, run).find();
        if (result.status == RunStatus::partial) return result;
        if (!result.isDone() || !(workOf(result, reduction.nodes) < least)) continue;
        least = workOf(result, reduction.nodes);
        best = result;
        best.unreducedWork = work;
    }
    if (repeat == 0) return best;
    StudyPoint at = own;
    at.step = best.step;
    at.tolerance = best.tolerance;
    at.reduction = best.reduction;
    PointResult timed = run(at, repeat);
    timed.unreducedWork = best.unreducedWork;
    return timed;
}

}  // namespace extremal
