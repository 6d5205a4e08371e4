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
        climb();
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
    static constexpr int perOctave = 3;  ///< rungs of the ladder of steps

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

    /// What one run may take. Steps that are too long may be dear: an iteration that does not end, a point
    /// that bounces without end. They must not use up what shorter steps need.
    double roomFor(long long n) const {
        constexpr double least = 1e-3, part = 0.1, spare = 2;
        const double left = std::max(search_.seconds - spent(), least);
        const double predicted = costPerStep_ * static_cast<double>(n);
        return std::min(left, std::max(part * left, spare * predicted));
    }

    /// False: there was no time for it, which is kept as what is known of this step.
    bool run(long long n) {
        if (const auto at = known_.find(n); at != known_.end())
            return at->second.judgement != Judgement::unknown;
        StudyPoint point;
        point.scheme = scheme_;
        point.step = length_ / static_cast<double>(n);
        const CostLimit limit{.seconds = roomFor(n), .watch = &watch_};
        const double begin = spent();
        const PointResult result =
            runPoint(scene_, point, search_.metrics,
                     search_.reference ? search_.reference() : ExactSolution{}, 0, limit, stop_);
        const bool isCutOff = result.isCutOff || result.status == RunStatus::partial;
        if (isCutOff && !stop_.stop_requested())
            known_.emplace(n, Known{Judgement::unknown, StepLimit::time, PointResult::unknown});
        if (isCutOff) return false;
        if (result.isDone()) costPerStep_ = (spent() - begin) / static_cast<double>(n);
        std::vector<JudgedValue> values(search_.wishes.begin(), search_.wishes.end());
        for (std::size_t i = 0; i < values.size(); ++i) values[i].value = result.errorIn(i);
        const Judgement judgement = judge(result.status, result.cause, values);
        if (judgement == Judgement::unknown) return false;
        known_.emplace(n, Known{judgement, reasonOf(judgement, point.step, n), result.error});
        return true;
    }

    /// Steps in thirds of octaves, from one that is of the scene's own order: first longer ones, then shorter
    /// ones, then what is left of the longest, which may cost more than all the others and matter least.
    void climb() {
        constexpr double forLonger = 0.2, forShorter = 0.7, forRest = 0.8;
        const int middle = rungOf(length_ / longestSensible());
        int longer = middle - 1;
        for (; longer >= 0 && !isOver(forLonger); --longer) (void)run(stepsOf(longer));
        const int shortest = descend(middle, forShorter);
        for (int k = shortest - 1; k > longer && !isOver(forRest); --k) (void)run(stepsOf(k));
        for (; longer >= 0 && !isOver(forRest); --longer) (void)run(stepsOf(longer));
        isTimeUpAbove_ = longer >= 0;
    }

    /// Until two octaves in a row are right with steps that resolve the fastest motion; the last rung.
    int descend(int from, double part) {
        constexpr int enough = 2 * perOctave + 1;
        constexpr double most = 2e5;
        int k = from;
        while (static_cast<double>(stepsOf(k)) <= most) {
            isTimeUpBelow_ = isOver(part);
            if (isTimeUpBelow_) break;
            (void)run(stepsOf(k));
            int right = 0;
            for (int i = k; i >= 0 && isRight(stepsOf(i)); --i) ++right;
            const double h = length_ / static_cast<double>(stepsOf(k));
            if (right >= enough && h * search_.frequencies.high() < 1) break;
            k += ahead(stepsOf(k));
        }
        return k;
    }

    /// How many rungs the claimed order is away from the wish, one less to be safe: one where something else
    /// than the accuracy is in the way.
    int ahead(long long n) const {
        const auto at = known_.find(n);
        const int order = scene_.schemes[scheme_].claims.order;
        if (at == known_.end() || at->second.reason != StepLimit::accuracy || order < 1) return 1;
        const double octaves = std::log2(at->second.error / search_.wishes.front().wish) / order;
        return std::clamp(static_cast<int>(perOctave * octaves) - 1, 1, 2 * perOctave);
    }

    /// The step of the scene, or one that resolves the fastest motion where that is longer.
    double longestSensible() const {
        const double own = scene_.schemes[scheme_].spec.step.value, fast = search_.frequencies.high();
        return fast > 0 ? std::max(own, 0.5 / fast) : own;
    }
    long long stepsOf(int rung) const {
        constexpr double first = 2;
        return std::llround(first * std::exp2(static_cast<double>(rung) / perOctave));
    }
    int rungOf(double steps) const {
        return std::max(0, static_cast<int>(std::floor(perOctave * std::log2(steps / 2))));
    }
    bool isRight(long long n) const {
        const auto at = known_.find(n);
        return at != known_.end() && at->second.judgement == Judgement::right;
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
                if (a->second.reason == StepLimit::time || b->second.reason == StepLimit::time) continue;
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
            all[i].below = i > 0 ? all[i - 1].reason : isTimeUpBelow_ ? StepLimit::time : StepLimit::shortest;
            all[i].above = i + 1 < all.size() ? all[i + 1].reason
                           : isTimeUpAbove_   ? StepLimit::time
                                              : StepLimit::longest;
        }
        return all;
    }

    const ResolvedScene& scene_;
    std::size_t scheme_;
    const StepSearch& search_;
    LinearLimits linear_;
    double length_, begin_;
    double costPerStep_ = 0;  ///< of the last run that came to its end
    std::stop_token stop_;
    ProcessorWatch watch_;
    bool isTimeUpBelow_ = false, isTimeUpAbove_ = false;
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
