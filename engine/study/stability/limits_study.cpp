// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/limits_study.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/stability/judged_wishes.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

LimitsStudy::LimitsStudy(ResolvedScene scene, LimitsOptions options)
    : scene_(std::move(scene)), options_(std::move(options)) {
    requireShard(options_.shard);
    metrics_ = metricsOf(options_.wishes, options_.metric, options_.isAtEnd, scene_);
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only)) rows_.push_back({scheme});
}

bool LimitsStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown; });
}

void LimitsStudy::take(std::size_t index, UsableSteps result) {
    rows_[index].result = std::move(result);
    rows_[index].isKnown = true;
}

void LimitsStudy::run(const std::function<void(std::size_t)>& onScheme, const std::stop_token& stop) {
    const auto wanted =
        wantedPoints(rows_.size(), options_.shard, [&](std::size_t i) { return rows_[i].isKnown; });
    if (wanted.empty()) return;
    progress_.begin();
    progress_.setPreparing(true);
    const JudgedWishes judged(scene_, metrics_, options_.wishes, stop);
    // Empty where no wish needs a reference; on a mesh of its own a scheme has other states.
    const ResolvedScheme& first = scene_.schemes[rows_.front().scheme];
    const MotionFrequencies frequencies =
        frequenciesAlong(scene_, first.ownSystem ? ExactSolution{} : judged.reference.of(first));
    progress_.setPreparing(false);
    if (stop.stop_requested()) return;
    ground_ = {frequencies.low(), frequencies.high(), judged.values.front().wish,
               judged.values.front().floor};
    ExpectedTime time;
    for (std::size_t k = 0; k < wanted.size(); ++k) time.add(options_.seconds);
    progress_.announce(time.onThreads(options_.threads), true);
    const auto compute = [&](std::size_t i) {
        const std::size_t scheme = rows_[i].scheme;
        const StepSearch search{judged.metrics, judged.values,
                                [&] { return judged.reference.of(scene_.schemes[scheme]); }, frequencies,
                                options_.seconds};
        return usableSteps(scene_, scheme, search, stop);
    };
    progress_.run(wanted, options_.threads, stop, compute, [&](std::size_t i, UsableSteps result) {
        take(i, std::move(result));
        onScheme(i);
    });
}

Value optionsValue(const LimitsOptions& options) {
    Value value;
    value.set("metric", options.metric);
    value.set("final", options.isAtEnd);
    value.set("wishes", valueOf(options.wishes));
    value.set("seconds", options.seconds);
    value.set("only", arrayOf(options.only));
    return value;
}

LimitsOptions limitsOptionsOf(const Value& value) {
    LimitsOptions options;
    options.metric = value.find("metric")->asString();
    options.isAtEnd = value.find("final")->asBool();
    options.wishes = wishesOf(*value.find("wishes"));
    options.seconds = value.find("seconds")->asNumber();
    options.only = textsOf(*value.find("only"));
    return options;
}

std::string headOf(const std::string& study, const LimitsStudy& limits) {
    return headOf(study, optionsValue(limits.options()), limits.scene().scene);
}

std::optional<std::size_t> takeLine(const std::string& line, LimitsStudy& limits) {
    constexpr std::size_t first = 4, perRange = 8;
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.front() == "frequencies" && cells.size() == 5)
        limits.take(LimitsStudy::Ground{cellNumber(cells[1]), cellNumber(cells[2]), cellNumber(cells[3]),
                                        cellNumber(cells[4])});
    if (cells.front() != "scheme" || cells.size() < first || (cells.size() - first) % perRange != 0)
        return {};
    const auto index = cellIndex(cells[1]);
    if (index >= limits.size()) return {};
    UsableSteps result;
    result.runs = static_cast<int>(cellNumber(cells[2]));
    result.reason = withCommas(cells[3]);
    for (std::size_t i = first; i < cells.size(); i += perRange)
        result.ranges.push_back({cellNumber(cells[i]), cellNumber(cells[i + 1]), judgementOf(cells[i + 2]),
                                 stepLimitOf(cells[i + 3]), stepLimitOf(cells[i + 4]),
                                 stepLimitOf(cells[i + 5]), cellNumber(cells[i + 6]),
                                 cellNumber(cells[i + 7])});
    limits.take(index, std::move(result));
    return index;
}

void runLines(LimitsStudy& limits, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    bool isGroundTold = false;
    limits.run(
        [&](std::size_t i) {
            const LimitsStudy::Ground& g = limits.ground();
            if (!std::exchange(isGroundTold, true))
                onLine("frequencies" + cellsText({g.omegaLow, g.omegaHigh, g.wish, g.floor}));
            const UsableSteps& r = limits.rows()[i].result;
            std::string line =
                "scheme," + std::to_string(i) + ',' + std::to_string(r.runs) + ',' + withoutCommas(r.reason);
            for (const StepRange& range : r.ranges) {
                line += cellsText({range.from, range.to});
                line += ',' + std::string(name(range.judgement));
                for (const StepLimit limit : {range.reason, range.below, range.above})
                    line += ',' + std::string(name(limit));
                line += cellsText({range.errorFrom, range.errorTo});
            }
            onLine(line);
        },
        stop);
}

}  // namespace extremal
