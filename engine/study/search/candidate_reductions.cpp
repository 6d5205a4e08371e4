// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a search that leaves something out of the space of a scheme.
#include <algorithm>
#include <cmath>

#include "engine/study/search/candidate_search.hpp"

namespace extremal {

/// First smaller degrees and fewer nodes, then what else the space may do without.
void CandidateSearch::reduce(std::size_t index, std::span<const double> wishes, PointResult& result) {
    const ResolvedScheme& whole = schemeOf(index);
    if (const Reduction has = richnessOf(whole); has && knobs_.isDegree) {
        std::vector<Variant> variants;
        for (const Reduction& reduction : reductionsOf(whole, scene_)) {
            const double share = static_cast<double>(reduction.nodes) / has.nodes;
            // With more steps it could not be cheaper, even if its nodes took half as many evaluations.
            variants.push_back({reduction, share, 2 / share});
        }
        raceOfVariants(index, variants, wishes, result);
    }
    if (!knobs_.isSmaller || result.reduction.cells > 0) return;
    std::vector<Variant> variants;
    for (const auto& [reduction, share] : smallerReductionsOf(whole, result.reduction, scene_))
        variants.push_back({reduction, share, 2 / share});
    if (!areSmallerNested(whole)) return raceOfVariants(index, variants, wishes, result);
    // What fails with one of them fails with less: one after another, until two in a row are no better.
    constexpr int enough = 2;
    double kept = 1;
    int misses = 0;
    for (const Variant& variant : variants) {
        const double share = variant.costShare / kept;
        raceOfVariants(index, {{variant.reduction, share, 2 / share}}, wishes, result);
        const bool isTaken = result.reduction == variant.reduction;
        if (isTaken) kept = variant.costShare;
        misses = isTaken ? 0 : misses + 1;
        if (misses == enough) break;
    }
}

/// The lowest cost among variants, with the steps with which they could be cheaper than what was found.
void CandidateSearch::raceOfVariants(std::size_t index, const std::vector<Variant>& variants,
                                     std::span<const double> wishes, PointResult& result) {
    if (variants.empty() || isTimeUp()) return;
    StudyPoint own = schemes_[index].point;
    own.reduction = result.reduction;
    // Not every scheme takes as many steps as the run was asked for.
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const auto& known) {
        const double n = std::get<5>(known.first);
        return known.first == keyOf(own, n) && known.second.result.step == result.step &&
               known.second.result.tolerance == result.tolerance;
    });
    if (found == known_.end()) return;
    const double n = std::get<5>(found->first), cost = found->second.cost;
    std::vector<StudyPoint> points{own};
    std::vector<ResolvedScheme> schemes{extremal::schemeOf(scene_, own)};
    std::vector<RaceEntry> entries(1);
    entries[0].isSingle = true;
    entries[0].firstN = n;
    for (const Variant& variant : variants) {
        points.push_back(own);
        points.back().reduction = variant.reduction;
        schemes.push_back(extremal::schemeOf(scene_, points.back()));
        RaceEntry entry;
        entry.order = std::max(1, schemes.back().claims.order);
        entry.firstN = n;
        entry.firstCost = cost * variant.costShare;
        entry.mostN = n * variant.stepShare;
        entries.push_back(entry);
    }
    CandidateRace race(entries);
    drive(race, seconds_,
          [&](const RaceJob& job) { return runOf(points[job.entry], schemes[job.entry], job, wishes); });
    const auto winner = race.winner();
    if (!winner || *winner == 0) return;
    const RaceRun& best = race.runsOf(*winner)[*race.bestOf(*winner)];
    const double before = std::isfinite(result.unreducedWork) ? result.unreducedWork
                                                              : workOf(result, richnessOf(schemes[0]).nodes);
    std::vector<TriedRun> tried = std::move(result.tried);
    std::string reason = std::move(result.reason);
    result = knownAt(points[*winner], best.n);
    result.tried = std::move(tried);
    result.reason = std::move(reason);
    result.unreducedWork = before;
    result.excess = best.excess;
}

}  // namespace extremal
