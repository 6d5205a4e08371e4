#include "engine/study/extremes_study.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "engine/core/pool.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

struct ExtremesStudy::Counters {
    std::atomic<std::size_t> done{0}, wanted{0};
};

ExtremesStudy::ExtremesStudy(Shard shard, unsigned threads)
    : shard_(shard), threads_(threads), counters_(std::make_shared<Counters>()) {
    requireShard(shard_);
    for (const ExtremeCase& each : extremeCases()) rows_.push_back({each});
}

bool ExtremesStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown(); });
}

double ExtremesStudy::fraction() const {
    const std::size_t wanted = counters_->wanted;
    return wanted > 0 ? static_cast<double>(counters_->done) / static_cast<double>(wanted) : 0;
}

void ExtremesStudy::run(const std::function<void(std::size_t)>& onCase, const std::stop_token& stop) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (shard_.has(i) && !rows_[i].isKnown()) wanted.push_back(i);
    counters_->wanted = wanted.size();
    std::mutex mutex;
    forEachInPool(wanted, threads_, stop, [&](std::size_t i) {
        ExtremeResult result = runExtreme(rows_[i].at, stop);
        if (stop.stop_requested()) return;
        const std::lock_guard lock(mutex);
        take(i, std::move(result));
        onCase(i);
        ++counters_->done;
    });
}

std::string headOf(const std::string& study, const ExtremesStudy& extremes) {
    std::string all;
    for (const ExtremesStudy::Row& row : extremes.rows()) all += row.at.text();
    return headOf(study, Value(Value::Object{}), all);
}

std::optional<std::size_t> takeLine(const std::string& line, ExtremesStudy& extremes) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != 5 || cells.front() != "case") return {};
    const auto index = static_cast<std::size_t>(parseNumber(cells[1]).value_or(1e18));
    if (index >= extremes.size()) return {};
    extremes.take(index, {cells[2], cellNumber(cells[3]), cellNumber(cells[4])});
    return index;
}

void runLines(ExtremesStudy& extremes, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    extremes.run(
        [&](std::size_t i) {
            const ExtremeResult& r = extremes.rows()[i].result;
            onLine("case," + std::to_string(i) + ',' + r.kind + ',' + cellOf(r.measure) + ',' +
                   cellOf(r.failedAt));
        },
        stop);
}

}  // namespace extremal
