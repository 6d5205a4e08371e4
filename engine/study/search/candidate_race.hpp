// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of many candidates reaches a wish at the lowest cost, with as few runs as will tell.
///
/// A candidate is a scheme, or a scheme with a smaller degree; n is its number of steps, or 1/tolerance. A
/// run has an excess, log(value/wish) of the worst wish, and a cost. All that is said of the cost of a run
/// that was not made comes from the runs before it, so that the race knows no clock. Always that candidate
/// goes on whose next run is the cheapest:
///
///     failed, or an error like the motion itself     n -> 2 n  (tolerance / 10)
///     one run below that                             n for the wish at the claimed order, or 2 n if only
///     that
///                                                    is cheaper than the best found
///     two or more                                    the slope m of the last two, within [0.7 p, 2.5 p];
///                                                    error not halved while n grew by 4: n -> 2 n
///     dropped                                        if even with the slope max(1.3 p, m) the wish would
///     cost
///                                                    more than the best found (times mostTimes)
///     reached                                        the secant between the last failure and the first
///                                                    success, until they are 3 % apart (20 % of tolerances)
///
/// No run may cost more than the best found: whoever makes it cuts it off there. At the end the winner is
/// confirmed with 10 % more steps; if it fails, its step was a happy accident, and the race goes on.
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace extremal {

struct RaceEntry {
    double order = 1;           ///< claimed: the error falls like n^-order; 1 of tolerances
    bool isAdaptive = false;    ///< n is 1/tolerance
    bool isSingle = false;      ///< there is one run alone
    bool hasOtherKnob = false;  ///< searched elsewhere, with another knob as well
    double firstN = 6;          ///< where to begin
    double firstCost = 0;       ///< of that run, as far as it is known
    /// Costs of whole runs, by n, as a few steps tell them: for what no run has told yet.
    std::vector<std::pair<double, double>> trials = {};
    double mostN = 1e7;
    /// Searched while a run costs at most so many times the best found of all.
    double mostTimes = 1;
};

struct RaceRun {
    double n = 0;
    double excess = std::numeric_limits<double>::infinity();  ///< infinity: failed
    double cost = 0;
    bool isSaturated = false;  ///< an error like the motion itself
    bool isCutOff = false;     ///< at the limit of its cost
    bool isAtFloor = false;    ///< an error that no finer step improves
};

/// A run that is to be made.
struct RaceJob {
    std::size_t entry = 0;
    double n = 0;
    double predictedCost = 0;
    double limit = std::numeric_limits<double>::infinity();  ///< of its cost
    bool isConfirmation = false;
};

enum class RaceEnd {
    open,
    reached,
    dearer,    ///< would reach the wish, at a higher cost
    cutOff,    ///< its first run was dearer than the answer
    failing,   ///< no run without failure, or with an error below that of the motion, at a lower cost
    stalled,   ///< its error does not fall at a lower cost than that of the best
    atFloor,   ///< its error does not fall any more
    exhausted  ///< more than mostN steps, or too many runs
};

class CandidateRace {
public:
    explicit CandidateRace(std::vector<RaceEntry> entries);

    /// What somebody else reaches the wish for: no run may cost more.
    void setKnownCost(double cost) { knownCost_ = cost; }
    /// The next run; none at the end of the race.
    std::optional<RaceJob> next();
    void take(const RaceJob& job, const RaceRun& run);

    /// The index of the cheapest run that reaches the wish, among runsOf(entry); none: not reached.
    std::optional<std::size_t> bestOf(std::size_t entry) const;
    const std::vector<RaceRun>& runsOf(std::size_t entry) const { return states_[entry].runs; }
    RaceEnd endOf(std::size_t entry) const { return states_[entry].end; }
    /// Of one that was dropped: the n that it would take, and its cost; 0: not known.
    double predictedN(std::size_t entry) const { return states_[entry].predictedN; }
    double predictedCost(std::size_t entry) const { return states_[entry].predictedCost; }
    /// The entry that costs least; empty where the wish has not been reached.
    std::optional<std::size_t> winner() const;
    /// n of the run that confirmed it; 0: none did.
    double confirmedAt(std::size_t entry) const { return states_[entry].confirmedAt; }

private:
    struct State {
        std::vector<RaceRun> runs;  ///< by n
        RaceEnd end = RaceEnd::open;
        double predictedN = 0, predictedCost = 0;
        double dipsBelow = 0;  ///< successes up to this n are accidents
        double confirmedAt = 0;
        int made = 0, accidents = 0;
        std::optional<std::pair<double, double>> again;  ///< n and cost of a run that was cut off too early
    };
    struct Plan {
        double n, cost;
    };
    static void keep(State& state, const RaceRun& run);
    std::optional<Plan> planOf(std::size_t entry);
    std::optional<Plan> finer(std::size_t entry, double limit);
    std::optional<Plan> between(std::size_t entry, double limit);
    double costAt(std::size_t entry, double n) const;
    /// Whether all runs have failed, so that they tell nothing of costs.
    bool isUnknown(std::size_t entry) const;
    double limitOf(std::size_t entry) const;
    double bestCost() const;
    std::optional<Plan> drop(std::size_t entry, RaceEnd end, double n = 0);
    double rounded(std::size_t entry, double n) const;

    double knownCost_ = std::numeric_limits<double>::infinity();
    std::vector<RaceEntry> entries_;
    std::vector<State> states_;
};

}  // namespace extremal
