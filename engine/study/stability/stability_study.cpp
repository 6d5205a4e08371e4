// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/stability_study.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/stability/peaks.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

StabilityStudy::StabilityStudy(ResolvedScene scene, StabilityOptions options)
    : scene_(std::move(scene)), options_(std::move(options)) {
    requireShard(options_.shard);
    requireNumber(scene_.scene, options_.x, "--x");
    if (options_.y) requireNumber(scene_.scene, *options_.y, "--y");
    std::vector<double> ys{StabilityResult::unknown};
    if (options_.y) ys = options_.y->values();
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only))
        for (const double y : ys) {
            for (const double x : options_.x.values()) rows_.push_back({scheme, x, y, {}});
            if (options_.findsLimits) limits_.push_back({scheme, y, false, {}});
        }
}

bool StabilityStudy::isKnown(std::size_t index) const {
    return index < rows_.size() ? rows_[index].result.kind != StabilityClass::waiting
                                : limits_[index - rows_.size()].isKnown;
}

bool StabilityStudy::isComplete() const {
    for (std::size_t i = 0; i < size(); ++i)
        if (!isKnown(i)) return false;
    return true;
}

void StabilityStudy::take(std::size_t index, const Result& result) {
    if (const auto* limit = std::get_if<StabilityLimit>(&result)) {
        limits_[index - rows_.size()].limit = *limit;
        limits_[index - rows_.size()].isKnown = true;
    } else {
        rows_[index].result = std::get<StabilityResult>(result);
    }
}

std::vector<std::pair<std::string, double>> StabilityStudy::changesAt(double y) const {
    std::vector<std::pair<std::string, double>> changes;
    if (options_.y) changes.emplace_back(options_.y->pointer, y);
    return changes;
}

StabilityStudy::Result StabilityStudy::resultAt(std::size_t index, const std::stop_token& stop) const {
    if (index >= rows_.size()) {
        const Limit& limit = limits_[index - rows_.size()];
        return findLimit(scene_.scene, limit.scheme, options_.x, changesAt(limit.y), stop);
    }
    auto changes = changesAt(rows_[index].y);
    changes.emplace_back(options_.x.pointer, rows_[index].x);
    return runStability(scene_.scene, rows_[index].scheme, changes, stop);
}

/// Of the points, along x; a limit is found by some fifteen runs beside those of half its axis.
double StabilityStudy::secondsAhead(const std::vector<std::size_t>& wanted,
                                    const std::stop_token& stop) const {
    constexpr double bisections = 15;
    ExpectedTime time;
    double sum = 0;
    std::size_t points = 0;
    const auto secondsOf = [&](std::size_t k) {
        const Row& row = rows_[wanted[k]];
        auto changes = changesAt(row.y);
        changes.emplace_back(options_.x.pointer, row.x);
        const double seconds = secondsOfStability(scene_.scene, row.scheme, changes, stop);
        sum += seconds;
        ++points;
        return seconds;
    };
    const auto isLimit = [&](std::size_t index) { return index >= rows_.size(); };
    const auto limits = static_cast<std::size_t>(std::count_if(wanted.begin(), wanted.end(), isLimit));
    time.addSeries(
        wanted.size() - limits,
        [&](std::size_t a, std::size_t b) { return rows_[wanted[a]].scheme == rows_[wanted[b]].scheme; },
        secondsOf);
    const double runs = bisections + 0.5 * static_cast<double>(options_.x.values().size());
    for (std::size_t k = 0; k < limits && points > 0; ++k) time.add(runs * sum / static_cast<double>(points));
    return time.onThreads(options_.threads);
}

void StabilityStudy::run(const std::function<void(std::size_t)>& onPoint, const std::stop_token& stop) {
    const auto wanted = wantedPoints(size(), options_.shard, [&](std::size_t i) { return isKnown(i); });
    progress_.begin();
    progress_.announce(secondsAhead(wanted, stop));
    const auto compute = [&](std::size_t i) { return resultAt(i, stop); };
    progress_.run(wanted, options_.threads, stop, compute, [&](std::size_t i, const Result& result) {
        take(i, result);
        onPoint(i);
    });
}

std::vector<ResonancePeak> resonancesOf(const StabilityStudy& stability) {
    constexpr double least = 10, roundOff = 1e-13;
    std::vector<ResonancePeak> all;
    if (stability.options().y) return all;
    const std::string& pointer = stability.options().x.pointer;
    const bool isStep = pointer.starts_with("/schemes/") && pointer.ends_with("/step");
    const double w = isStep ? highestFrequency(*stability.scene().system, stability.scene().initial) : 0;
    const auto& rows = stability.rows();
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        double largest = 0;
        for (; last < rows.size() && rows[last].scheme == rows[first].scheme; ++last)
            if (rows[last].result.isBounded()) largest = std::max(largest, rows[last].result.maxEnergyError);
        std::vector<double> values;
        for (std::size_t i = first; i < last; ++i) {
            const StabilityResult& r = rows[i].result;
            const bool isKnown = r.kind != StabilityClass::waiting && r.kind != StabilityClass::refused;
            values.push_back(!isKnown        ? StabilityResult::unknown
                             : r.isBounded() ? std::max(r.maxEnergyError, roundOff * largest)
                                             : std::numeric_limits<double>::infinity());
        }
        for (const Peak& peak : findPeaks(values, least)) {
            const double x = (rows[first + peak.first].x + rows[first + peak.last].x) / 2;
            all.push_back({rows[first].scheme, x, rows[first + peak.first].result.maxEnergyError,
                           peak.prominence, w > 0 ? w * x : StabilityResult::unknown});
            if (!std::isfinite(values[peak.first])) all.back().energyError = StabilityResult::unknown;
        }
        first = last;
    }
    return all;
}

Value optionsValue(const StabilityOptions& options) {
    Value value;
    value.set("x", textOf(options.x));
    value.set("y", options.y ? textOf(*options.y) : "");
    value.set("limit", options.findsLimits);
    value.set("only", arrayOf(options.only));
    return value;
}

StabilityOptions stabilityOptionsOf(const Value& value) {
    StabilityOptions options;
    options.x = parseAxis(value.find("x")->asString(), "--x");
    if (const std::string& y = value.find("y")->asString(); !y.empty()) options.y = parseAxis(y, "--y");
    options.findsLimits = value.find("limit")->asBool();
    options.only = textsOf(*value.find("only"));
    return options;
}

std::string headOf(const std::string& study, const StabilityStudy& stability) {
    return headOf(study, optionsValue(stability.options()), stability.scene().scene);
}

std::optional<std::size_t> takeLine(const std::string& line, StabilityStudy& stability) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() < 5) return {};
    const auto index = cellIndex(cells[1]);
    if (cells.front() == "limit" && index >= stability.rows().size() && index < stability.size()) {
        StabilityLimit limit;
        limit.limit = cellNumber(cells[2]);
        limit.low = cellNumber(cells[3]);
        limit.high = cellNumber(cells[4]);
        stability.take(index, limit);
        return index;
    }
    if (cells.front() != "point" || cells.size() != 8 || index >= stability.rows().size()) return {};
    StabilityResult r;
    for (const StabilityClass c : {StabilityClass::stable, StabilityClass::drifting, StabilityClass::blowUp,
                                   StabilityClass::solverFailed, StabilityClass::refused})
        if (name(c) == cells[2]) r.kind = c;
    r.cause = outcomeOf(cells[3]);
    r.growth = cellNumber(cells[4]);
    r.maxEnergyError = cellNumber(cells[5]);
    r.failedAt = cellNumber(cells[6]);
    r.judgement = judgementOf(cells[7]);
    stability.take(index, r);
    return index;
}

void runLines(StabilityStudy& stability, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    stability.run(
        [&](std::size_t i) {
            const std::size_t points = stability.rows().size();
            if (i < points) {
                const StabilityResult& r = stability.rows()[i].result;
                onLine("point," + std::to_string(i) + ',' + std::string(name(r.kind)) + ',' +
                       std::string(name(r.cause)) + cellsText({r.growth, r.maxEnergyError, r.failedAt}) +
                       ',' + std::string(name(r.judgement)));
            } else {
                const StabilityLimit& l = stability.limits()[i - points].limit;
                onLine("limit," + std::to_string(i) + cellsText({l.limit, l.low, l.high}));
            }
        },
        stop);
}

}  // namespace extremal
