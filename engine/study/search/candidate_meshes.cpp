// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a search that changes elements and steps together.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/study/search/candidate_search.hpp"

namespace extremal {
namespace {

constexpr int fewestCells = 4;
/// No run is made that costs so many times the dearest on the mesh that the search begins with.
constexpr double mostTimesItsOwn = 100;

double dearestOnOwnMesh(const MeshFit& fit) {
    double most = 0;
    for (const MeshRun& run : fit.runs())
        if (run.cells == fit.firstCells()) most = std::max(most, run.cost);
    return most > 0 ? most : HUGE_VAL;
}

}  // namespace

/// How many unknowns a run has for each of the scene: what is counted is work on each of them.
double CandidateSearch::unknownsOf(const StudyPoint& own) const {
    const ResolvedScheme& scheme = scene_.schemes[own.scheme];
    const auto size = static_cast<double>(scene_.initial.x.size());
    const auto unknowns = [&](const ResolvedScheme& of) {
        return of.ownSystem && size > 0 ? static_cast<double>(of.ownInitial.x.size()) / size : 1.0;
    };
    if (own.reduction.smaller > 0) return unknowns(extremal::schemeOf(scene_, own));
    const int cells = own.reduction.cells;
    return unknowns(scheme) * (cells > 0 ? cells / double(cellsOf(scheme, scene_)) : 1);
}

/// CPU seconds; or what is counted, on the mesh of the run: a step on twice as many unknowns costs twice as
/// much.
double CandidateSearch::costOf(const StudyPoint& own, const PointResult& result) const {
    if (!isCounted_) return result.cpuSeconds;
    return unknownsOf(own) * workOf(result, richnessOf(schemeAt(scene_, own.scheme, result)).nodes);
}

bool CandidateSearch::hasMesh(std::size_t index) const {
    return entries_[index] && entries_[index]->hasOtherKnob;
}

/// From the mesh and the step of each scheme.
void CandidateSearch::beginMeshes() {
    for (std::size_t i = 0; i < schemes_.size(); ++i) {
        if (!hasMesh(i)) continue;
        const ResolvedScheme& scheme = schemeOf(i);
        // Of one that the scene has not got: as many unknowns as its linear elements have.
        const int degree = schemes_[i].isOfScene ? 1 : std::max(1, scheme.properties.curveOrder - 1);
        meshes_.try_emplace(i, std::max(fewestCells, cellsOf(scheme, scene_) / degree),
                            length_ / schemes_[i].point.step / degree, scheme.claims.order,
                            scheme.orderInSpace(), fewestCells);
    }
}

MeshRun CandidateSearch::meshRunOf(std::size_t index, const MeshPair& pair, double limit,
                                   std::span<const double> wishes) {
    StudyPoint own = schemes_[index].point;
    if (pair.cells != cellsOf(schemeOf(index), scene_)) own.reduction.cells = pair.cells;
    // Of the first run nothing is known.
    const RaceJob job{index, pair.steps, pair.cost > 0 ? pair.cost : HUGE_VAL, limit, false};
    const RaceRun run = runOf(own, schemeOf(index), job, wishes);
    MeshRun made{pair.cells, pair.steps, HUGE_VAL, run.cost, run.isCutOff, false};
    const PointResult& known = knownAt(own, pair.steps);
    if (known.isDone() && !isSaturated(known) && std::isfinite(run.excess))
        made.error = wishes.size() == 1 ? known.errorIn(0) : std::exp(run.excess);
    return made;
}

/// With a tenth more steps it must reach the wishes as well.
bool CandidateSearch::isConfirmed(std::size_t index, const MeshRun& best, std::span<const double> wishes) {
    constexpr double more = 1.1;
    const double steps = std::ceil(best.steps * more);
    const MeshRun finer = meshRunOf(index, {best.cells, steps, best.cost * more}, HUGE_VAL, wishes);
    if (finer.error > wantedOf(wishes)) return false;
    confirmedMeshes_[index] = steps;
    return true;
}

double CandidateSearch::leastCost(const CandidateRace& race, std::span<const double> wishes) const {
    double least = HUGE_VAL;
    if (const auto winner = race.winner()) least = race.runsOf(*winner)[*race.bestOf(*winner)].cost;
    for (const auto& [index, fit] : meshes_)
        if (const MeshRun* const best = fit.best(wantedOf(wishes))) least = std::min(least, best->cost);
    return least;
}

/// Seconds of the first run of a scheme, of which nothing else is known.
double CandidateSearch::firstSeconds(std::size_t index, const MeshPair& pair) {
    const auto known = firstSeconds_.find(index);
    if (known != firstSeconds_.end()) return known->second;
    constexpr double longestTrial = 0.02;
    constexpr long long steps = 2;
    const ResolvedScheme& scheme = schemeOf(index);
    StudyPoint own = schemes_[index].point;
    if (pair.cells != cellsOf(scheme, scene_)) own.reduction.cells = pair.cells;
    const StepCost cost = tryPoint(scene_, pointAt(own, scheme, pair.steps), steps,
                                   {.seconds = longestTrial * seconds_, .watch = &watch_}, stop_);
    const double all = cost.isCutOff ? HUGE_VAL : pair.steps * cost.seconds;
    return firstSeconds_.emplace(index, std::isnan(all) ? 0 : all).first->second;
}

/// Always the scheme that promises to be the cheapest, until none can be cheaper, or so much has been spent;
/// the best is confirmed. Schemes whose first run takes longer than `longestFirst` seconds are left alone.
void CandidateSearch::searchMeshes(const CandidateRace& race, std::span<const double> wishes, double seconds,
                                   double longestFirst) {
    beginMeshes();
    confirmedMeshes_.clear();
    while (!meshes_.empty() && !stop_.stop_requested() && spent_ < seconds) {
        const double begin = threadSeconds(), least = leastCost(race, wishes);
        std::optional<std::pair<std::size_t, MeshPair>> job;
        double limit = 0, lowest = HUGE_VAL;
        for (auto& [index, fit] : meshes_) {
            const double most = std::min(least * (schemes_[index].isOfScene ? mostTimesTheLeast : 1),
                                         mostTimesItsOwn * dearestOnOwnMesh(fit));
            const auto next = fit.next(wantedOf(wishes), most);
            if (!next) continue;
            const bool isFirst = fit.runs().empty() && std::isfinite(longestFirst);
            if (isFirst && firstSeconds(index, *next) > longestFirst) continue;
            // Those go on that promise to be the cheapest, not those whose next run is.
            const double price = fit.isKnown() ? next->cost : fit.promisedCost(wantedOf(wishes));
            if (!job || price < lowest) job = {index, *next}, limit = most, lowest = price;
        }
        if (job) {
            meshes_.at(job->first).take(meshRunOf(job->first, job->second, limit, wishes));
        } else {
            bool isOpen = false;
            for (auto& [index, fit] : meshes_) {
                const MeshRun* const best = fit.best(wantedOf(wishes));
                if (!best || best->cost > least || confirmedMeshes_.contains(index)) continue;
                if (isConfirmed(index, *best, wishes)) continue;
                fit.reject(best->cells, best->steps);
                isOpen = true;
            }
            if (!isOpen) return;
        }
        spent_ += threadSeconds() - begin;
    }
}

/// "Gauss 2 cannot give less than 3.7e-3 with 200 cells".
std::string CandidateSearch::floorOfMesh(std::size_t index, std::span<const double> wishes) const {
    const auto fit = meshes_.find(index);
    if (fit == meshes_.end() || wishes.size() != 1) return {};
    const int own = cellsOf(schemeOf(index), scene_);
    const double floor = fit->second.floorOf(own);
    if (!(floor > wishes[0])) return {};
    return "cannot give less than " + formatNumber(floor, 2) + " with " + std::to_string(own) + " cells";
}

/// In place of what the race found on the mesh of the scheme, if it is cheaper; else what is known of it.
void CandidateSearch::takeMesh(std::size_t index, const CandidateRace& race, std::span<const double> wishes,
                               PointResult& result) const {
    const auto found = meshes_.find(index);
    if (found == meshes_.end()) return;
    const MeshFit& fit = found->second;
    const std::string floor = floorOfMesh(index, wishes), behind = floor.empty() ? "" : "; " + floor;
    const int own = cellsOf(schemeOf(index), scene_);
    const double least = leastCost(race, wishes);
    if (const MeshRun* const best = fit.best(wantedOf(wishes))) {
        StudyPoint point = schemes_[index].point;
        if (best->cells != own) point.reduction.cells = best->cells;
        result = knownAt(point, best->steps);
        result.excess = excessOf(result, wishes);
        const auto confirmed = confirmedMeshes_.find(index);
        if (confirmed != confirmedMeshes_.end()) result.confirmedAt = length_ / confirmed->second;
        result.reason =
            (best->cost > least ? "reached, " + timesDearer(best->cost / least) : "the cheapest") + behind;
        return;
    }
    if (!result.isDone()) explainMesh(index, least, wishes, result);
}

/// Of a scheme that has not reached the wishes: its floor, and what would reach them.
void CandidateSearch::explainMesh(std::size_t index, double least, std::span<const double> wishes,
                                  PointResult& result) const {
    const MeshFit& fit = meshes_.at(index);
    const int own = cellsOf(schemeOf(index), scene_);
    std::string reason = floorOfMesh(index, wishes);
    const std::vector<MeshRun>& runs = fit.runs();
    const auto nearest = std::min_element(
        runs.begin(), runs.end(), [](const MeshRun& a, const MeshRun& b) { return a.error < b.error; });
    if (nearest == runs.end()) return;
    StudyPoint point = schemes_[index].point;
    if (nearest->cells != own) point.reduction.cells = nearest->cells;
    result = knownAt(point, nearest->steps);
    result.excess = excessOf(result, wishes);
    result.status = RunStatus::failed;
    if (result.cause == Outcome::refused) return;
    result.reason = isTimeUp() ? "the search ended after " + formatNumber(seconds_, 2) + " s"
                               : "no run below the best cost reaches it";
    if (!reason.empty()) {
        result.floorOf = "mesh";
        result.floor = fit.floorOf(own);
    }
    if (const auto pair = fit.next(wantedOf(wishes), HUGE_VAL); pair && fit.isKnown()) {
        const bool isDearer = std::isfinite(least) && pair->cost > least;
        if (isDearer) result.timesCheapest = pair->cost / least;
        reason += (reason.empty() ? "" : "; ") + std::string("would need about ") +
                  formatNumber(pair->cells, 2) + " cells and " + formatNumber(pair->steps, 2) + " steps" +
                  (isDearer ? ", " + timesDearer(pair->cost / least) : "");
    }
    if (!reason.empty()) result.reason = reason;
}

PointResult CandidateSearch::fullResultOf(const CandidateRace& race, std::size_t index,
                                          std::span<const double> wishes) const {
    PointResult result = resultOf(race, index, leastCost(race, wishes));
    takeMesh(index, race, wishes, result);
    result.tried = triedBy(index);
    return result;
}

}  // namespace extremal
