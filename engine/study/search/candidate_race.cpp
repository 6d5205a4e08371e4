// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/candidate_race.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace extremal {
namespace {

constexpr int mostRuns = 40, mostAccidents = 4;
constexpr double strictest = 1e15;  ///< 1/tolerance

}  // namespace

CandidateRace::CandidateRace(std::vector<RaceEntry> entries)
    : entries_(std::move(entries)), states_(entries_.size()) {}

double CandidateRace::rounded(std::size_t entry, double n) const {
    return entries_[entry].isAdaptive ? n : std::round(n);
}

std::optional<std::size_t> CandidateRace::bestOf(std::size_t entry) const {
    const State& s = states_[entry];
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < s.runs.size(); ++i) {
        const RaceRun& r = s.runs[i];
        if (r.excess > 0 || r.n <= s.dipsBelow) continue;
        if (!best || r.cost < s.runs[*best].cost) best = i;
    }
    return best;
}

double CandidateRace::bestCost() const {
    double least = knownCost_;
    for (std::size_t e = 0; e < entries_.size(); ++e)
        if (const auto best = bestOf(e)) least = std::min(least, states_[e].runs[*best].cost);
    return least;
}

std::optional<std::size_t> CandidateRace::winner() const {
    std::optional<std::size_t> first;
    double least = HUGE_VAL;
    for (std::size_t e = 0; e < entries_.size(); ++e)
        if (const auto best = bestOf(e); best && states_[e].runs[*best].cost < least) {
            least = states_[e].runs[*best].cost;
            first = e;
        }
    return first;
}

double CandidateRace::limitOf(std::size_t entry) const { return bestCost() * entries_[entry].mostTimes; }

bool CandidateRace::isUnknown(std::size_t entry) const {
    const std::vector<RaceRun>& runs = states_[entry].runs;
    return std::none_of(runs.begin(), runs.end(), [](const RaceRun& r) { return std::isfinite(r.excess); });
}

/// From the nearest run, with the exponent of the last two.
double CandidateRace::costAt(std::size_t entry, double n) const {
    const RaceEntry& own = entries_[entry];
    const double usual = own.isAdaptive ? 0.15 : 1, least = own.isAdaptive ? 0.03 : 0.4,
                 most = own.isAdaptive ? 0.5 : 1.1;
    const std::vector<RaceRun>& runs = states_[entry].runs;
    if (isUnknown(entry) && !own.trials.empty()) {
        auto at = own.trials.front();
        for (const auto& trial : own.trials)
            if (trial.first <= n) at = trial;
        return at.second * n / at.first;
    }
    if (runs.empty()) return own.firstCost * std::pow(n / own.firstN, usual);
    // Of those that have failed only where there is no other.
    std::size_t near = 0;
    const auto distance = [&](std::size_t i) {
        return std::pair{!isUnknown(entry) && !std::isfinite(runs[i].excess),
                         std::abs(std::log(runs[i].n / n))};
    };
    for (std::size_t i = 1; i < runs.size(); ++i)
        if (distance(i) < distance(near)) near = i;
    double g = usual;
    if (near > 0 && runs[near].excess < HUGE_VAL && runs[near - 1].excess < HUGE_VAL)
        g = std::clamp(
            std::log(runs[near].cost / runs[near - 1].cost) / std::log(runs[near].n / runs[near - 1].n),
            least, most);
    return runs[near].cost * std::pow(n / runs[near].n, std::isfinite(g) ? g : usual);
}

std::optional<CandidateRace::Plan> CandidateRace::drop(std::size_t entry, RaceEnd end, double n) {
    State& s = states_[entry];
    s.end = end;
    s.predictedN = n;
    s.predictedCost = n > 0 ? costAt(entry, n) : 0;
    return {};
}

std::optional<CandidateRace::Plan> CandidateRace::planOf(std::size_t entry) {
    const RaceEntry& own = entries_[entry];
    State& s = states_[entry];
    const double limit = limitOf(entry);
    const auto best = bestOf(entry);
    if (s.again && s.again->second <= limit) return Plan{s.again->first, s.again->second};
    const bool isLonger = s.again && best && s.again->first < s.runs[*best].n;
    if (s.again && (isLonger || (isUnknown(entry) && !own.trials.empty()))) {
        // Steps that are too long may cost more than shorter ones: as far as trials, or what has reached the
        // wish, tell, it goes on.
        const double n = s.again->first;
        keep(s, {n, HUGE_VAL, own.firstCost, false, true, false});
    } else if (s.again) {
        if (best) return drop(entry, RaceEnd::reached);
        if (s.runs.empty()) return drop(entry, RaceEnd::cutOff);
        const RaceRun& last = s.runs.back();
        const bool isUsable = std::isfinite(last.excess) && !last.isSaturated;
        return drop(entry, isUsable ? RaceEnd::dearer : RaceEnd::failing);
    }
    if (own.isSingle && s.made > 0) return drop(entry, best ? RaceEnd::reached : RaceEnd::atFloor);
    if (s.made >= mostRuns) return drop(entry, best ? RaceEnd::reached : RaceEnd::exhausted);
    if (own.hasOtherKnob) return drop(entry, RaceEnd::cutOff);
    if (s.runs.empty()) {
        // The first steps of a run, which have none before them to begin from, cost more than the others; and
        // no run costs more than the limit.
        constexpr double firstSteps = 3;
        if (own.firstCost > firstSteps * limit) return drop(entry, RaceEnd::cutOff);
        return Plan{own.firstN, own.firstCost};
    }
    return best ? between(entry, limit) : finer(entry, limit);
}

/// Between a failure and a success, or below the first success.
std::optional<CandidateRace::Plan> CandidateRace::between(std::size_t entry, double limit) {
    const RaceEntry& own = entries_[entry];
    State& s = states_[entry];
    const double apart = own.isAdaptive ? 1.2 : 1.03;
    const RaceRun good = s.runs[*bestOf(entry)];
    const RaceRun* bad = nullptr;
    for (const RaceRun& r : s.runs)
        if (r.n < good.n && (r.excess > 0 || r.n <= s.dipsBelow)) bad = &r;
    double n = 0;
    if (bad) {
        if (good.n <= bad->n * apart || (!own.isAdaptive && good.n - bad->n <= 1))
            return drop(entry, RaceEnd::reached, good.n);
        // Between the two it might be the cheapest, or not any more. What has failed says nothing of it.
        if (bad->cost > limit && std::isfinite(bad->excess)) return drop(entry, RaceEnd::reached, good.n);
        double part = 0.5;  // of the way from bad to good, on the logarithmic scale
        if (std::isfinite(bad->excess) && std::isfinite(good.excess) && bad->excess > 0)
            part = std::clamp(bad->excess / (bad->excess - good.excess), 0.15, 0.9);
        n = rounded(entry, bad->n * std::pow(good.n / bad->n, part));
        if (!own.isAdaptive) n = std::clamp(n, bad->n + 1, good.n - 1);
    } else {
        if (good.n <= (own.isAdaptive ? 10 : 1)) return drop(entry, RaceEnd::reached, good.n);
        const double factor =
            std::isfinite(good.excess) ? std::exp(good.excess / own.order) * 0.97 : 1.0 / 16;
        n = rounded(entry, good.n * std::clamp(factor, 1.0 / 16, own.isAdaptive ? 0.8 : 0.97));
        n = own.isAdaptive ? std::max(10.0, n) : std::max(1.0, std::min(n, good.n - 1));
    }
    return Plan{n, costAt(entry, n)};
}

/// Beyond the last failure.
std::optional<CandidateRace::Plan> CandidateRace::finer(std::size_t entry, double limit) {
    const RaceEntry& own = entries_[entry];
    State& s = states_[entry];
    const RaceRun& last = s.runs.back();
    const double mostN = own.isAdaptive ? strictest : own.mostN, twice = own.isAdaptive ? 10 : 2,
                 most = own.isAdaptive ? 1e5 : 16;
    const auto isUsable = [](const RaceRun& r) { return std::isfinite(r.excess) && !r.isSaturated; };
    if (last.isAtFloor) return drop(entry, RaceEnd::atFloor);
    if (last.n >= mostN) return drop(entry, RaceEnd::exhausted);
    const auto farther = [&](double n, RaceEnd end) -> std::optional<Plan> {
        n = std::min(n, mostN);
        const double cost = costAt(entry, n);
        if (cost > limit) return drop(entry, end);
        return Plan{n, cost};
    };
    if (!isUsable(last)) return farther(twice * last.n, RaceEnd::failing);
    // A slope, and whether the error has stopped falling.
    double m = own.order;
    bool isAlone = true, isStalled = false, isPlateau = false;
    for (std::size_t i = s.runs.size() - 1; i-- > 0 && isUsable(s.runs[i]);) {
        const RaceRun& before = s.runs[i];
        if (before.excess <= 0) continue;  // an accident
        const double grown = last.n / before.n, gain = before.excess - last.excess;
        if (isAlone) m = std::clamp(gain / std::log(grown), 0.7 * own.order, 2.5 * own.order);
        isAlone = false;
        isStalled = isStalled || (grown >= 4 && gain < std::log(2));
        isPlateau = isPlateau || (grown >= std::pow(twice, 5) && gain < std::log(2));
    }
    if (isPlateau) return drop(entry, RaceEnd::atFloor);
    if (isStalled) return farther(twice * last.n, RaceEnd::stalled);
    const auto nAt = [&](double slope) { return last.n * std::exp(std::min(last.excess / slope, 300.0)); };
    const double wanted = std::max(rounded(entry, 1.02 * nAt(m)), last.n + 1);
    double n = std::min({wanted, most * last.n, mostN});
    if (costAt(entry, n) <= limit &&
        (wanted <= n || costAt(entry, nAt(std::max(1.3 * own.order, m))) <= limit))
        return Plan{n, costAt(entry, n)};
    if (isAlone && costAt(entry, twice * last.n) <= limit) return farther(twice * last.n, RaceEnd::dearer);
    if (costAt(entry, nAt(std::max(1.3 * own.order, m))) > limit)
        return drop(entry, RaceEnd::dearer, std::min(wanted, 1e300));
    // As far as the best found lets it.
    double low = last.n, high = n;
    for (int i = 0; i < 40; ++i) {
        const double middle = std::sqrt(low * high);
        (costAt(entry, middle) <= limit ? low : high) = middle;
    }
    n = rounded(entry, low);
    if (n < 1.05 * last.n || n < last.n + 1) return drop(entry, RaceEnd::dearer, wanted);
    return Plan{n, costAt(entry, n)};
}

std::optional<RaceJob> CandidateRace::next() {
    std::optional<RaceJob> job;
    for (std::size_t e = 0; e < entries_.size(); ++e) {
        if (states_[e].end != RaceEnd::open) continue;
        if (const auto plan = planOf(e); plan && (!job || plan->cost < job->predictedCost))
            job = RaceJob{e, plan->n, plan->cost, limitOf(e), false};
    }
    if (job) return job;
    const auto first = winner();
    if (!first || states_[*first].confirmedAt > 0 || entries_[*first].isSingle) return {};
    const RaceRun& best = states_[*first].runs[*bestOf(*first)];
    const double n = entries_[*first].isAdaptive ? 1.3 * best.n : std::ceil(1.1 * best.n);
    return RaceJob{*first, n, costAt(*first, n), HUGE_VAL, true};
}

void CandidateRace::take(const RaceJob& job, const RaceRun& run) {
    State& s = states_[job.entry];
    ++s.made;
    if (run.isCutOff) {
        // At the limit it could only be dearer; before that, its cost was not foreseen.
        const bool isAtLimit = run.cost >= limitOf(job.entry);
        s.again = std::pair{job.n, isAtLimit ? HUGE_VAL : 4 * std::max(run.cost, job.predictedCost)};
        return;
    }
    keep(s, run);
    if (!job.isConfirmation) return;
    if (run.excess <= 0) {
        s.confirmedAt = run.n;
        return;
    }
    const bool isHopeless = ++s.accidents > mostAccidents;
    s.dipsBelow = isHopeless ? HUGE_VAL : run.n;
    s.end = isHopeless ? RaceEnd::exhausted : RaceEnd::open;
}

void CandidateRace::keep(State& s, const RaceRun& run) {
    s.again.reset();
    const auto place =
        std::find_if(s.runs.begin(), s.runs.end(), [&](const RaceRun& r) { return r.n >= run.n; });
    if (place != s.runs.end() && place->n == run.n)
        *place = run;
    else
        s.runs.insert(place, run);
}

}  // namespace extremal
