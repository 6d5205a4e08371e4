// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/extremes_study.hpp"

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/cells.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/stability/judged_wishes.hpp"
#include "engine/study/study_log.hpp"

namespace extremal {
namespace {

/// The axis along x at a value of y.
ExtremeAxis axisAlong(const ResolvedScene& scene, const ExtremesOptions& options,
                      const std::optional<double>& y) {
    ExtremeAxis axis;
    axis.id = axis.pointer = options.x.pointer;
    axis.title = "of the scene";
    if (y) {
        axis.fixed = {{options.y->pointer, *y}};
        axis.id += " at " + options.y->pointer + " = " + formatNumber(*y);
    }
    axis.scene = toValue(scene.scene);
    for (const double x : options.x.values()) axis.values.push_back(formatNumber(x));
    axis.usual = axis.values.size();
    axis.schemes = axis.scene.find("schemes")->asArray();
    axis.measured = options.metric;
    axis.isAtEnd = options.isAtEnd;
    axis.wishes = options.wishes;
    return axis;
}

}  // namespace

ExtremesStudy::ExtremesStudy(Shard shard, unsigned threads, bool withLong)
    : shard_(shard), threads_(threads), withLong_(withLong) {
    requireShard(shard_);
    for (const ExtremeCase& each : extremeCases(withLong)) rows_.push_back({each});
}

ExtremesStudy::ExtremesStudy(const ResolvedScene& scene, const ExtremesOptions& options)
    : shard_(options.shard),
      threads_(options.threads),
      options_(std::make_shared<const ExtremesOptions>(options)),
      sceneText_(writeScene(scene.scene)) {
    requireShard(shard_);
    requireNumber(scene.scene, options.x, "--x");
    if (options.y) requireNumber(scene.scene, *options.y, "--y");
    (void)metricsOf(options.wishes, options.metric, options.isAtEnd, scene);
    std::vector<ExtremeAxis> axes;
    if (options.y)
        for (const double y : options.y->values()) axes.push_back(axisAlong(scene, options, y));
    else
        axes.push_back(axisAlong(scene, options, {}));
    own_ = std::make_shared<const std::vector<ExtremeAxis>>(std::move(axes));
    const std::vector<std::size_t> chosen = chosenSchemes(scene.scene, options.only);
    for (const ExtremeCase& each : extremeCases(*own_, false))
        if (std::find(chosen.begin(), chosen.end(), each.scheme) != chosen.end()) rows_.push_back({each});
}

bool ExtremesStudy::isComplete() const {
    return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.isKnown(); });
}

/// Along the values of each scheme on each axis; what judges a case is tried once, in the middle.
double ExtremesStudy::secondsAhead(const std::vector<std::size_t>& wanted,
                                   const std::stop_token& stop) const {
    if (wanted.empty()) return 0;
    const double judging = secondsOfJudging(rows_[wanted[wanted.size() / 2]].at, stop);
    ExpectedTime time;
    const auto caseAt = [&](std::size_t k) -> const ExtremeCase& { return rows_[wanted[k]].at; };
    time.addSeries(
        wanted.size(),
        [&](std::size_t a, std::size_t b) {
            return caseAt(a).axis == caseAt(b).axis && caseAt(a).scheme == caseAt(b).scheme;
        },
        [&](std::size_t k) {
            return judging + secondsOfScene([&] { return readScene(caseAt(k).text()); }, stop);
        });
    return time.onThreads(threads_);
}

void ExtremesStudy::run(const std::function<void(std::size_t)>& onCase, const std::stop_token& stop) {
    const auto wanted = wantedPoints(rows_.size(), shard_, [&](std::size_t i) { return rows_[i].isKnown(); });
    progress_.begin();
    progress_.announce(secondsAhead(wanted, stop));
    const auto compute = [&](std::size_t i) { return runExtreme(rows_[i].at, stop); };
    progress_.run(wanted, threads_, stop, compute, [&](std::size_t i, ExtremeResult result) {
        take(i, std::move(result));
        onCase(i);
    });
}

std::string headOf(const std::string& study, const ExtremesStudy& extremes) {
    std::string all;
    if (extremes.options()) return headOf(study, optionsValue(*extremes.options()), extremes.sceneText());
    for (const ExtremesStudy::Row& row : extremes.rows()) all += row.at.text();
    return headOf(study, Value(Value::Object{{"long", extremes.hasLong()}}), all);
}

Value optionsValue(const ExtremesOptions& options) {
    Value value;
    value.set("x", textOf(options.x));
    value.set("y", options.y ? textOf(*options.y) : "");
    value.set("metric", options.metric);
    value.set("final", options.isAtEnd);
    value.set("wishes", valueOf(options.wishes));
    value.set("only", arrayOf(options.only));
    return value;
}

ExtremesOptions extremesOptionsOf(const Value& value) {
    ExtremesOptions options;
    options.x = parseAxis(value.find("x")->asString(), "--x");
    if (const std::string& y = value.find("y")->asString(); !y.empty()) options.y = parseAxis(y, "--y");
    options.metric = value.find("metric")->asString();
    options.isAtEnd = value.find("final")->asBool();
    options.wishes = wishesOf(*value.find("wishes"));
    options.only = textsOf(*value.find("only"));
    return options;
}

std::optional<std::size_t> takeLine(const std::string& line, ExtremesStudy& extremes) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != 7 || cells.front() != "case") return {};
    const auto index = cellIndex(cells[1]);
    if (index >= extremes.size()) return {};
    extremes.take(index, {cells[2], cellNumber(cells[3]), cellNumber(cells[4]), judgementOf(cells[5]),
                          cellNumber(cells[6])});
    return index;
}

void runLines(ExtremesStudy& extremes, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop) {
    extremes.run(
        [&](std::size_t i) {
            const ExtremeResult& r = extremes.rows()[i].result;
            onLine("case," + std::to_string(i) + ',' + r.kind + cellsText({r.measure, r.failedAt}) + ',' +
                   std::string(name(r.judgement)) + cellsText({r.floor}));
        },
        stop);
}

}  // namespace extremal
