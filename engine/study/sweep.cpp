// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/pool.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/reference/map_reference.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/study/search/search.hpp"

namespace extremal {

namespace {

/// Of a reference that is asked itself.
constexpr std::size_t noRow = std::numeric_limits<std::size_t>::max();

}  // namespace

Sweep::Sweep(ResolvedScene scene, SweepOptions options)
    : scene_(std::move(scene)),
      options_(std::move(options)),
      metric_(metricOf(options_.metric, options_.isAtEnd, *scene_.system, scene_.initial)) {
    requireShard(options_.shard);
    if (options_.repeat < 0 || options_.repeat > 1000)
        throw InvalidScene("--repeat", "must be 0 to 1000, got " + std::to_string(options_.repeat));
    if (metric_.observable->needsReference && scene_.scene.reference.kind == ReferenceSpec::Kind::none)
        throw InvalidScene("/reference", "errors need a reference, and the scene has none",
                           "\"auto\", or --metric energy");
    const bool isSearch = options_.wantedError != 0;
    if (isSearch && !(std::isfinite(options_.wantedError) && options_.wantedError > 0))
        throw InvalidScene("--error",
                           "must be positive and finite, got " + formatNumber(options_.wantedError));
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only))
        if (isSearch)
            addOwnPoint(scheme);
        else
            addLadder(scheme);
}

/// Where a search begins. No table of the reference has the nodes that it will ask for.
void Sweep::addOwnPoint(std::size_t scheme) {
    const ResolvedScheme& own = scene_.schemes[scheme];
    StudyPoint point;
    point.scheme = scheme;
    if (own.isAdaptive())
        point.tolerance = own.spec.tolerance.value_or(1e-6);
    else
        point.step = own.spec.step.value;
    point.row = noRow;
    rows_.push_back({point, {}});
}

void Sweep::addLadder(std::size_t scheme) {
    const ResolvedScheme& own = scene_.schemes[scheme];
    for (const double value : ladderOf(options_.ladder, scene_, own)) {
        StudyPoint point;
        point.scheme = scheme;
        if (own.isAdaptive()) {
            point.tolerance = value;
            point.row = noRow;
        } else {
            point.step = value;
            const auto known = std::find(steps_.begin(), steps_.end(), value);
            point.row = static_cast<std::size_t>(known - steps_.begin());
            if (known == steps_.end()) steps_.push_back(value);
        }
        rows_.push_back({point, {}});
    }
}

bool Sweep::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const SweepRow& row) {
        return row.result.status == RunStatus::done || row.result.status == RunStatus::failed;
    });
}

void Sweep::run(const std::function<void(const ReferenceInfo&)>& onReference,
                const std::function<void(std::size_t, const PointResult&)>& onPoint,
                const std::stop_token& stop) {
    const std::vector<std::size_t> wanted = wantedPoints(rows_.size(), options_.shard, [&](std::size_t i) {
        return rows_[i].result.status != RunStatus::waiting;
    });
    if (wanted.empty()) return;
    MapReference reference;
    Reference scheme;  // what adaptive runs, whose nodes no table has, are compared with
    if (metric_.observable->needsReference) {
        progress_.setPreparing(true);
        reference = MapReference(scene_, steps_, stop);
        if (scene_.scene.reference.kind == ReferenceSpec::Kind::scheme) scheme = makeReference(scene_, stop);
        progress_.setPreparing(false);
        reference_ = scheme.make ? scheme.info : reference.info();
        if (stop.stop_requested()) return;
        if (onReference) onReference(reference_);
    }
    const auto referenceOf = [&](const StudyPoint& point) {
        const ResolvedScheme& run = scene_.schemes[point.scheme];
        if (point.step == 0 && scheme.make && !run.ownSystem) return scheme.make();
        return reference.at(point.row, scene_, run);
    };
    const Run run = [&](const StudyPoint& at, int repeat) {
        return runPoint(scene_, at, metric_, referenceOf(at), repeat, stop);
    };
    const bool isSearch = options_.wantedError > 0;
    const std::vector<Prospect> all = isSearch ? prospects(run, stop) : std::vector<Prospect>{};
    const double least = leastWork(all);
    const auto compute = [&](std::size_t i) {
        const StudyPoint& point = rows_[i].point;
        return isSearch ? search(point, all[i], least, run) : run(point, options_.repeat);
    };
    progress_.run(wanted, options_.threads, stop, compute, [&](std::size_t i, PointResult result) {
        rows_[i].result = std::move(result);
        if (onPoint) onPoint(i, rows_[i].result);
    });
}

/// Of all schemes, whatever the shard: each shard has to drop the same.
std::vector<Prospect> Sweep::prospects(const Run& run, const std::stop_token& stop) const {
    std::vector<Prospect> all(rows_.size());
    if (all.size() < 2) return all;
    std::vector<std::size_t> every(rows_.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    forEachInPool(every, options_.threads, stop, [&](std::size_t i) {
        const StudyPoint& point = rows_[i].point;
        all[i] = prospectOf(scene_.schemes[point.scheme], run(point, 0), options_.wantedError);
    });
    return all;
}

/// The largest step with the wanted error, sought only where it may be the cheapest.
PointResult Sweep::search(const StudyPoint& point, const Prospect& prospect, double least,
                          const Run& run) const {
    constexpr double most = 1e7;
    const double budget = mostTimesTheLeast * least,
                 steps = prospect.perStep > 0 ? std::min(most, budget / prospect.perStep) : most;
    const bool isHopeless = prospect.work > budget;
    PointResult result = isHopeless ? run(point, 0)
                                    : searchPoint(scene_, point, options_.wantedError, options_.repeat, run,
                                                  std::max(1.0, std::floor(steps)));
    if (isHopeless && result.isDone()) result.status = RunStatus::failed;
    if (result.status == RunStatus::failed && steps < most)
        result.timesCheapest = std::max(prospect.work / least, mostTimesTheLeast);
    if (result.isDone())
        result.predictedSeconds = predictSeconds(scene_, schemeAt(scene_, point.scheme, result));
    return result;
}

std::vector<SchemeRows> bySchemes(const Sweep& sweep) {
    std::vector<SchemeRows> all;
    const std::vector<SweepRow>& rows = sweep.rows();
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last < rows.size() && rows[last].point.scheme == rows[first].point.scheme) ++last;
        all.push_back({rows[first].point.scheme, std::span(rows).subspan(first, last - first)});
        first = last;
    }
    return all;
}

}  // namespace extremal
