// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/extremes_study.hpp"

#include <algorithm>

#include "engine/study/cells.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

ExtremesStudy::ExtremesStudy(Shard shard, unsigned threads, bool withLong)
    : shard_(shard), threads_(threads), withLong_(withLong) {
    requireShard(shard_);
    for (const ExtremeCase& each : extremeCases(withLong)) rows_.push_back({each});
}

bool ExtremesStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown(); });
}

void ExtremesStudy::run(const std::function<void(std::size_t)>& onCase, const std::stop_token& stop) {
    const auto wanted = wantedPoints(rows_.size(), shard_, [&](std::size_t i) { return rows_[i].isKnown(); });
    const auto compute = [&](std::size_t i) { return runExtreme(rows_[i].at, stop); };
    progress_.run(wanted, threads_, stop, compute, [&](std::size_t i, ExtremeResult result) {
        take(i, std::move(result));
        onCase(i);
    });
}

std::string headOf(const std::string& study, const ExtremesStudy& extremes) {
    std::string all;
    for (const ExtremesStudy::Row& row : extremes.rows()) all += row.at.text();
    return headOf(study, Value(Value::Object{{"long", extremes.hasLong()}}), all);
}

std::optional<std::size_t> takeLine(const std::string& line, ExtremesStudy& extremes) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != 5 || cells.front() != "case") return {};
    const auto index = cellIndex(cells[1]);
    if (index >= extremes.size()) return {};
    extremes.take(index, {cells[2], cellNumber(cells[3]), cellNumber(cells[4])});
    return index;
}

void runLines(ExtremesStudy& extremes, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    extremes.run(
        [&](std::size_t i) {
            const ExtremeResult& r = extremes.rows()[i].result;
            onLine("case," + std::to_string(i) + ',' + r.kind + cellsText({r.measure, r.failedAt}));
        },
        stop);
}

}  // namespace extremal
