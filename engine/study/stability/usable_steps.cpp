// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/usable_steps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/thread_clock.hpp"
#include "engine/family/frequency.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/study/search/ladder.hpp"
#include "engine/study/search/point.hpp"

namespace extremal {
namespace {

constexpr std::pair<StepLimit, std::string_view> limitNames[] = {{StepLimit::longest, "longest tried"},
                                                                 {StepLimit::shortest, "shortest tried"},
                                                                 {StepLimit::time, "time of the search"},
                                                                 {StepLimit::accuracy, "accuracy"},
                                                                 {StepLimit::stability, "stability"},
                                                                 {StepLimit::resonance, "resonance"},
                                                                 {StepLimit::solver, "solver"},
                                                                 {StepLimit::refusal, "refused"},
                                                                 {StepLimit::floor, "floor"},
                                                                 {StepLimit::single, "single step"}};

/// Linear stability of one scheme along a motion.
class LinearLimits {
public:
    LinearLimits(const ResolvedScheme& scheme, const MotionFrequencies& frequencies)
        : facts_(stabilityOf(scheme)), frequencies_(frequencies) {}

    /// stability, resonance, or none.
    StepLimit at(double h, double steps) const {
        if (!facts_) return StepLimit::none;
        double sum = 0;
        for (const std::vector<double>& place : frequencies_.places) {
            double growth = 0;
            for (const double w : place) {
                const UnstableInterval* const interval = facts_->at(h * w);
                if (!interval) continue;
                if (!interval->isBounded()) return StepLimit::stability;
                growth = std::max(growth, facts_->growth(h * w));
            }
            sum += growth;
        }
        const double mean = sum / static_cast<double>(std::max<std::size_t>(frequencies_.places.size(), 1));
        return mean * steps > 1 ? StepLimit::resonance : StepLimit::none;
    }

    /// Long steps are stable: what is lost there is another root of the equations of a step.
    bool hasNone() const {
        return facts_ && std::all_of(facts_->intervals.begin(), facts_->intervals.end(),
                                     [](const UnstableInterval& i) { return i.isBounded(); });
    }

    /// Steps in the middle of bounded intervals, at the start of the motion.
    std::vector<double> resonantSteps() const {
        std::vector<double> all;
        if (!facts_ || frequencies_.places.empty()) return all;
        for (const UnstableInterval& i : facts_->intervals)
            for (const double w : frequencies_.places.front())
                if (i.isBounded()) all.push_back((i.low + i.high) / (2 * w));
        return all;
    }

private:
    std::shared_ptr<const LinearStabilityFacts> facts_;
    const MotionFrequencies& frequencies_;
};

class StepScan {
public:
    StepScan(const ResolvedScene& scene, std::size_t scheme, const StepSearch& search,
             const std::stop_token& stop)
        : scene_(scene),
          scheme_(scheme),
          search_(search),
          linear_(scene.schemes[scheme], search.frequencies),
          length_(timeSpan(scene.scene).length()),
          begin_(threadSeconds()),
          stop_(stop) {}

    UsableSteps find() {
        descend();
        addResonances();
        bisect();
        UsableSteps found{ranges(), {}, static_cast<int>(known_.size())};
        return found;
    }

private:
    struct Known {
        Judgement judgement;
        StepLimit reason;
        double error;
    };
    using Place = std::map<long long, Known>::const_iterator;

    double spent() const { return threadSeconds() - begin_; }
    bool isOver(double part) const { return stop_.stop_requested() || spent() > part * search_.seconds; }

    StepLimit reasonOf(Judgement judgement, double h, long long n) const {
        if (judgement == Judgement::right) return StepLimit::none;
        if (judgement == Judgement::refused) return StepLimit::refusal;
        if (judgement == Judgement::notJudged) return StepLimit::floor;
        const StepLimit linear = linear_.at(h, static_cast<double>(n));
        if (linear != StepLimit::none) return linear;
        if (judgement == Judgement::diverged) return StepLimit::solver;
        if (judgement == Judgement::lost) return linear_.hasNone() ? StepLimit::solver : StepLimit::stability;
        return StepLimit::accuracy;
    }

    /// False: there was no time for it.
    bool run(long long n) {
        if (known_.contains(n)) return true;
        constexpr double least = 1e-3;
        StudyPoint point;
        point.scheme = scheme_;
        point.step = length_ / static_cast<double>(n);
        CostLimit limit;
        limit.seconds = std::max(search_.seconds - spent(), least);
        const PointResult result =
            runPoint(scene_, point, search_.metrics,
                     search_.reference ? search_.reference() : ExactSolution{}, 0, limit, stop_);
        if (result.isCutOff || result.status == RunStatus::partial) return false;
        std::vector<JudgedValue> values(search_.wishes.begin(), search_.wishes.end());
        for (std::size_t i = 0; i < values.size(); ++i) values[i].value = result.errorIn(i);
        const Judgement judgement = judge(result.status, result.cause, values);
        if (judgement == Judgement::unknown) return false;
        known_.emplace(n, Known{judgement, reasonOf(judgement, point.step, n), result.error});
        return true;
    }

    /// Until two octaves in a row are right with steps that resolve the fastest motion.
    void descend() {
        constexpr int perOctave = 3, enough = 2 * perOctave + 1;
        constexpr double first = 2, most = 2e5, forLadder = 0.6;
        int right = 0;
        long long last = 0;
        for (int k = 0;; ++k) {
            const auto n = std::llround(first * std::exp2(static_cast<double>(k) / perOctave));
            if (n == last) continue;
            last = n;
            if (static_cast<double>(n) > most) return;
            isTimeUp_ = isOver(forLadder) || !run(n);
            if (isTimeUp_) return;
            right = known_.at(n).judgement == Judgement::right ? right + 1 : 0;
            const double h = length_ / static_cast<double>(n);
            if (right >= enough && h * search_.frequencies.high() < 1) return;
        }
    }

    void addResonances() {
        if (known_.empty()) return;
        const double longest = length_ / static_cast<double>(known_.begin()->first),
                     shortest = length_ / static_cast<double>(known_.rbegin()->first);
        for (const double h : linear_.resonantSteps()) {
            if (!(h < longest && h > shortest) || isOver(0.8)) continue;
            const auto n = std::llround(length_ / h);
            if (linear_.at(length_ / static_cast<double>(n), static_cast<double>(n)) == StepLimit::resonance)
                (void)run(n);
        }
    }

    /// First the changes beside steps that are right.
    void bisect() {
        constexpr double apart = 1.01;
        constexpr int mostRuns = 150;
        for (int made = 0; made < mostRuns && !isOver(1); ++made) {
            std::optional<long long> chosen;
            for (Place a = known_.begin(); a != known_.end(); ++a) {
                const Place b = std::next(a);
                if (b == known_.end()) break;
                const auto low = static_cast<double>(a->first), high = static_cast<double>(b->first);
                const bool isSame = a->second.judgement == b->second.judgement;
                if (isSame || b->first - a->first < 2 || high < apart * low) continue;
                const bool isEnd =
                    a->second.judgement == Judgement::right || b->second.judgement == Judgement::right;
                if (isEnd || !chosen)
                    chosen = std::clamp(std::llround(std::sqrt(low * high)), a->first + 1, b->first - 1);
                if (isEnd) break;
            }
            if (!chosen || !run(*chosen)) return;
        }
    }

    std::vector<StepRange> ranges() const {
        std::vector<StepRange> all;
        for (auto at = known_.rbegin(); at != known_.rend(); ++at) {  // ascending in h
            const auto& [judgement, reason, error] = at->second;
            const double h = length_ / static_cast<double>(at->first);
            if (all.empty() || all.back().judgement != judgement || all.back().reason != reason)
                all.push_back({h, h, judgement, reason, StepLimit::none, StepLimit::none, error, error});
            all.back().to = h;
            all.back().errorTo = error;
        }
        for (StepRange& range : all)
            if (range.isUsable() && range.from == range.to && known_.size() > 1)
                range.reason = StepLimit::single;
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].below = i > 0 ? all[i - 1].reason : isTimeUp_ ? StepLimit::time : StepLimit::shortest;
            all[i].above = i + 1 < all.size() ? all[i + 1].reason : StepLimit::longest;
        }
        return all;
    }

    const ResolvedScene& scene_;
    std::size_t scheme_;
    const StepSearch& search_;
    LinearLimits linear_;
    double length_, begin_;
    std::stop_token stop_;
    bool isTimeUp_ = false;
    std::map<long long, Known> known_;  ///< by the number of steps
};

}  // namespace

std::string_view name(StepLimit limit) {
    for (const auto& [each, text] : limitNames)
        if (each == limit) return text;
    return "";
}

StepLimit stepLimitOf(std::string_view text) {
    for (const auto& [each, known] : limitNames)
        if (known == text) return each;
    return StepLimit::none;
}

double MotionFrequencies::low() const {
    double least = 0;
    for (const std::vector<double>& place : places)
        if (!place.empty() && (least == 0 || place.front() < least)) least = place.front();
    return least;
}

double MotionFrequencies::high() const {
    double most = 0;
    for (const std::vector<double>& place : places)
        if (!place.empty()) most = std::max(most, place.back());
    return most;
}

MotionFrequencies frequenciesAlong(const ResolvedScene& scene, const ExactSolution& solution) {
    constexpr int fewPlaces = 41;
    MotionFrequencies all;
    State at = scene.initial;
    all.places.push_back(linearFrequencies(*scene.system, at));
    if (!solution || !scene.system->hasCoordinates()) return all;
    const double start = scene.scene.start.value, end = scene.scene.end.value;
    for (int i = 1; i < fewPlaces; ++i) {
        at.t = start + (end - start) * i / (fewPlaces - 1);
        solution(at.t, at.x);
        if (std::all_of(at.x.begin(), at.x.end(), [](double v) { return std::isfinite(v); }))
            all.places.push_back(linearFrequencies(*scene.system, at));
    }
    return all;
}

UsableSteps usableSteps(const ResolvedScene& scene, std::size_t scheme, const StepSearch& search,
                        const std::stop_token& stop) {
    const ResolvedScheme& own = scene.schemes[scheme];
    if (own.isAdaptive()) return {{}, "its steps follow from its tolerance", 0};
    if (!own.isFixed()) return {{}, "it chooses its own steps", 0};
    if (hasStepOfItsSpace(scene, own)) return {{}, "its step follows from its space", 0};
    return StepScan(scene, scheme, search, stop).find();
}

}  // namespace extremal
