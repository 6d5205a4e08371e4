// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/linear_study.hpp"

#include <algorithm>

#include "engine/study/cells.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

LinearStudy::LinearStudy(ResolvedScene scene, LinearOptions options)
    : scene_(std::move(scene)), options_(std::move(options)) {
    requireShard(options_.shard);
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only)) rows_.push_back({scheme});
}

bool LinearStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown; });
}

void LinearStudy::take(std::size_t index, LinearStability result) {
    rows_[index].result = std::move(result);
    rows_[index].isKnown = true;
}

void LinearStudy::run(const std::function<void(std::size_t)>& onScheme, const std::stop_token& stop) {
    const auto wanted =
        wantedPoints(rows_.size(), options_.shard, [&](std::size_t i) { return rows_[i].isKnown; });
    const auto compute = [&](std::size_t i) { return linearStability(scene_.scene, rows_[i].scheme, stop); };
    progress_.run(wanted, options_.threads, stop, compute, [&](std::size_t i, LinearStability result) {
        take(i, std::move(result));
        onScheme(i);
    });
}

Value optionsValue(const LinearOptions& options) {
    Value value;
    value.set("only", arrayOf(options.only));
    return value;
}

LinearOptions linearOptionsOf(const Value& value) {
    LinearOptions options;
    options.only = textsOf(*value.find("only"));
    return options;
}

std::string headOf(const std::string& study, const LinearStudy& linear) {
    return headOf(study, optionsValue(linear.options()), linear.scene().scene);
}

std::optional<std::size_t> takeLine(const std::string& line, LinearStudy& linear) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() < 3) return {};
    const auto index = cellIndex(cells[1]);
    if (index >= linear.size()) return {};
    LinearStability result;
    if (cells.front() == "refused") {
        result.reason = line.substr(line.find(',', line.find(',') + 1) + 1);
    } else if (cells.front() == "scheme" && cells.size() >= 5) {
        result.low = cellNumber(cells[2]);
        result.high = cellNumber(cells[3]);
        result.hasLimit = result.high == result.high;
        const std::size_t region = 5 + 3 * cellIndex(cells[4]);
        const std::size_t size = static_cast<std::size_t>(LinearRegion::columns * LinearRegion::rows);
        if (cells.size() != region && cells.size() != region + 3 * size) return {};
        for (std::size_t i = 5; i < region; i += 3)
            result.points.push_back(
                {cellNumber(cells[i]), cellNumber(cells[i + 1]), cellNumber(cells[i + 2])});
        for (std::size_t i = region; i < cells.size(); i += 3)
            result.region.points.push_back(
                {cellNumber(cells[i]), cellNumber(cells[i + 1]), cells[i + 2] == "1"});
    } else {
        return {};
    }
    linear.take(index, std::move(result));
    return index;
}

void runLines(LinearStudy& linear, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    linear.run(
        [&](std::size_t i) {
            const LinearStability& r = linear.rows()[i].result;
            if (!r.reason.empty()) {
                std::string reason = r.reason;
                std::replace(reason.begin(), reason.end(), '\n', ' ');
                onLine("refused," + std::to_string(i) + ',' + reason);
                return;
            }
            std::string line = "scheme," + std::to_string(i) + cellsText({r.low, r.high}) + ',' +
                               std::to_string(r.points.size());
            for (const LinearStability::Point& p : r.points)
                line += cellsText({p.z, p.amplification, p.phaseError});
            for (const LinearRegion::Point& p : r.region.points)
                line += cellsText({p.amplification, p.phaseError}) + (p.isOnCut ? ",1" : ",");
            onLine(line);
        },
        stop);
}

}  // namespace extremal
