// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/sweep_log.hpp"

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {
namespace {

long long count(const std::string& text) { return static_cast<long long>(parseNumber(text).value_or(0)); }

std::string numbersText(const std::vector<double>& numbers) {
    std::string text;
    for (const double each : numbers) text += (text.empty() ? "" : " ") + formatNumber(each);
    return text;
}
std::vector<double> numbersIn(const std::string& text) {
    std::vector<double> all;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t blank = std::min(text.find(' ', from), text.size());
        all.push_back(cellNumber(text.substr(from, blank - from)));
        from = blank + 1;
    }
    return all;
}

std::string pointLine(std::size_t index, const PointResult& r) {
    std::string line =
        "point," + std::to_string(index) + ',' + name(r.status) + ',' + std::string(name(r.cause));
    line += cellsText({r.failedAt, r.error});
    for (const long long value :
         {r.steps, r.cost.iterations, r.cost.evaluations, r.cost.linearSolves, r.cost.rejected})
        line += ',' + std::to_string(value);
    line += cellsText({r.cpuSeconds, r.cpuSpread, r.predictedSeconds, r.step, r.tolerance});
    line += ',' + std::to_string(r.reduction.degree) + ',' + std::to_string(r.reduction.nodes) + ',' +
            std::to_string(r.reduction.cells) + cellsText({r.reduction.solver, r.reduction.stepFactor}) +
            ',' + std::to_string(r.reduction.smaller);
    line += cellsText({r.unreducedWork, r.timesCheapest, r.excess, r.floor, r.confirmedAt, r.bytes});
    std::vector<double> tried;
    for (const TriedRun& run : r.tried)
        tried.insert(tried.end(), {run.cost, run.error, run.steps, static_cast<double>(run.cells)});
    return line + ',' + r.floorOf + ',' + withoutCommas(r.reason) + ',' + numbersText(r.errors) + ',' +
           std::to_string(r.scheme) + ',' + numbersText(tried);
}

std::optional<PointResult> pointOf(const std::vector<std::string>& cells) {
    if (cells.size() != 33) return {};
    PointResult r;
    r.status = cells[2] == name(RunStatus::done) ? RunStatus::done : RunStatus::failed;
    r.cause = outcomeOf(cells[3]);
    r.failedAt = cellNumber(cells[4]);
    r.error = cellNumber(cells[5]);
    r.steps = count(cells[6]);
    r.cost = {count(cells[7]), count(cells[8]), count(cells[9]), count(cells[10])};
    r.cpuSeconds = cellNumber(cells[11]);
    r.cpuSpread = cellNumber(cells[12]);
    r.predictedSeconds = cellNumber(cells[13]);
    r.step = cellNumber(cells[14]);
    r.tolerance = cellNumber(cells[15]);
    r.reduction = {static_cast<int>(count(cells[16])),
                   static_cast<int>(count(cells[17])),
                   static_cast<int>(count(cells[18])),
                   cellNumber(cells[19]),
                   cellNumber(cells[20]),
                   static_cast<int>(count(cells[21]))};
    r.unreducedWork = cellNumber(cells[22]);
    r.timesCheapest = cellNumber(cells[23]);
    r.excess = cellNumber(cells[24]);
    r.floor = cellNumber(cells[25]);
    r.confirmedAt = cellNumber(cells[26]);
    r.bytes = cellNumber(cells[27]);
    r.floorOf = cells[28];
    r.reason = withCommas(cells[29]);
    r.errors = numbersIn(cells[30]);
    r.scheme = cellIndex(cells[31]);
    const std::vector<double> tried = numbersIn(cells[32]);
    for (std::size_t i = 0; i + 3 < tried.size(); i += 4)
        r.tried.push_back({tried[i], tried[i + 1], tried[i + 2], static_cast<int>(tried[i + 3])});
    return r;
}

bool isSameButForTimes(PointResult a, PointResult b) {
    for (PointResult* r : {&a, &b}) {
        r->cpuSeconds = r->cpuSpread = r->predictedSeconds = PointResult::unknown;
        r->tried.clear();
        r->bytes = PointResult::unknown;
    }
    return pointLine(0, a) == pointLine(0, b);
}

}  // namespace

Value optionsValue(const SweepOptions& options) {
    Value value;
    value.set("metric", options.metric);
    value.set("final", options.isAtEnd);
    value.set("steps", arrayOf(options.ladder.steps));
    value.set("from", options.ladder.from);
    value.set("to", options.ladder.to);
    value.set("points", options.ladder.points);
    value.set("repeat", options.repeat);
    value.set("only", arrayOf(options.only));
    value.set("error", options.wantedError);
    value.set("wishes", valueOf(options.wishes));
    value.set("all candidates", options.hasAllCandidates);
    value.set("search time", options.searchSeconds);
    value.set("budget", options.budget);
    value.set("per time", options.isPerTime);
    value.set("memory", options.mostBytes);
    value.set("rungs", arrayOf(options.rungs));
    value.set("over", textOf(options.over));
    value.set("knobs", textOf(options.knobs));
    value.set("of", options.over.isMedian ? "median" : "");
    return value;
}

SweepOptions optionsOf(const Value& value) {
    SweepOptions options;
    options.metric = value.find("metric")->asString();
    options.isAtEnd = value.find("final")->asBool();
    options.ladder.steps = numbersOf(*value.find("steps"));
    options.ladder.from = value.find("from")->asNumber();
    options.ladder.to = value.find("to")->asNumber();
    options.ladder.points = static_cast<int>(value.find("points")->asNumber());
    options.repeat = static_cast<int>(value.find("repeat")->asNumber());
    options.only = textsOf(*value.find("only"));
    options.wantedError = value.find("error")->asNumber();
    options.wishes = wishesOf(*value.find("wishes"));
    options.hasAllCandidates = value.find("all candidates")->asBool();
    options.searchSeconds = value.find("search time")->asNumber();
    options.budget = value.find("budget")->asNumber();
    options.isPerTime = value.find("per time")->asBool();
    options.mostBytes = value.find("memory")->asNumber();
    options.rungs = numbersOf(*value.find("rungs"));
    options.knobs = parseKnobs(value.find("knobs")->asString());
    options.over = parseCases(value.find("over")->asString(), value.find("of")->asString());
    return options;
}

std::string headOf(const std::string& study, const Sweep& sweep) {
    return headOf(study, optionsValue(sweep.options()), sweep.scene().scene);
}

std::optional<std::size_t> takeLine(const std::string& line, Sweep& sweep) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.front() == "reference" && cells.size() == 4) {
        ReferenceInfo info;
        info.type = cells[1];
        info.estimatedError = cellNumber(cells[2]);
        sweep.take(info);
        const double size = cellNumber(cells[3]);
        sweep.takeSize(std::isfinite(size) ? size : HUGE_VAL);
    }
    if (cells.front() != "point") return {};
    const std::optional<PointResult> result = pointOf(cells);
    const std::size_t index = cellIndex(cells.size() > 1 ? cells[1] : "");
    if (!result || index >= sweep.size()) return {};
    const PointResult& known = sweep.rows()[index].result;
    if (known.status != RunStatus::waiting && !isSameButForTimes(known, *result))
        throw InvalidScene("arguments", "the logs have different results for point " + std::to_string(index),
                           "logs of the same version on the same kind of machine");
    sweep.take(index, *result);
    return index;
}

void runLines(Sweep& sweep, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    sweep.run(
        [&](const ReferenceInfo& info) {
            onLine("reference," + info.type + cellsText({info.estimatedError, sweep.metricSize()}));
        },
        [&](std::size_t i, const PointResult& result) { onLine(pointLine(i, result)); }, stop);
}

}  // namespace extremal
