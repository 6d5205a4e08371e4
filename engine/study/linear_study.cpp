#include "engine/study/linear_study.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "engine/core/pool.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {

struct LinearStudy::Counters {
    std::atomic<std::size_t> done{0}, wanted{0};
};

LinearStudy::LinearStudy(ResolvedScene scene, LinearOptions options)
    : scene_(std::move(scene)), options_(std::move(options)), counters_(std::make_shared<Counters>()) {
    requireShard(options_.shard);
    for (const std::size_t scheme : chosenSchemes(scene_.scene, options_.only)) rows_.push_back({scheme});
}

bool LinearStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown; });
}

double LinearStudy::fraction() const {
    const std::size_t wanted = counters_->wanted;
    return wanted > 0 ? static_cast<double>(counters_->done) / static_cast<double>(wanted) : 0;
}

void LinearStudy::take(std::size_t index, LinearStability result) {
    rows_[index].result = std::move(result);
    rows_[index].isKnown = true;
}

void LinearStudy::run(const std::function<void(std::size_t)>& onScheme, const std::stop_token& stop) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (options_.shard.has(i) && !rows_[i].isKnown) wanted.push_back(i);
    counters_->wanted = wanted.size();
    std::mutex mutex;
    forEachInPool(wanted, options_.threads, stop, [&](std::size_t i) {
        LinearStability result = linearStability(scene_.scene, rows_[i].scheme, stop);
        if (stop.stop_requested()) return;
        const std::lock_guard lock(mutex);
        take(i, std::move(result));
        onScheme(i);
        ++counters_->done;
    });
}

Value optionsValue(const LinearOptions& options) {
    Value value;
    Value::Array only;
    for (const std::string& label : options.only) only.emplace_back(label);
    value.set("only", only);
    return value;
}

LinearOptions linearOptionsOf(const Value& value) {
    LinearOptions options;
    for (const Value& label : value.find("only")->asArray()) options.only.push_back(label.asString());
    return options;
}

std::string headOf(const std::string& study, const LinearStudy& linear) {
    return headOf(study, optionsValue(linear.options()), linear.scene().scene);
}

std::optional<std::size_t> takeLine(const std::string& line, LinearStudy& linear) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() < 3) return {};
    const auto index = static_cast<std::size_t>(parseNumber(cells[1]).value_or(1e18));
    if (index >= linear.size()) return {};
    LinearStability result;
    if (cells.front() == "refused") {
        result.reason = line.substr(line.find(',', line.find(',') + 1) + 1);
    } else if (cells.front() == "scheme" && cells.size() % 3 == 1) {
        result.low = cellNumber(cells[2]);
        result.high = cellNumber(cells[3]);
        result.hasLimit = result.high == result.high;
        for (std::size_t i = 4; i < cells.size(); i += 3)
            result.points.push_back(
                {cellNumber(cells[i]), cellNumber(cells[i + 1]), cellNumber(cells[i + 2])});
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
            std::string line = "scheme," + std::to_string(i) + ',' + cellOf(r.low) + ',' + cellOf(r.high);
            for (const LinearStability::Point& p : r.points)
                for (const double value : {p.z, p.amplification, p.phaseError}) line += ',' + cellOf(value);
            onLine(line);
        },
        stop);
}

}  // namespace extremal
