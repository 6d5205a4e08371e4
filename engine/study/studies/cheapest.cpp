// SPDX-License-Identifier: GPL-3.0-or-later
/// Which scheme is cheapest for a wanted error: cheapest.csv.
#include <algorithm>
#include <cmath>

#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/model_in_place.hpp"
#include "engine/study/search/excess.hpp"

namespace extremal::studies {
namespace {

const std::vector<std::string>& cheapestColumns() {
    static const std::vector<std::string> names{
        "rank",        "label",       "step",     "predicted_cpu_seconds",
        "cpu_seconds", "evaluations", "error",    "kept",
        "left_out",    "tolerance",   "status",   "model_left_out",
        "excess",      "floor",       "floor_of", "confirmed_at",
        "reason",      "errors"};
    return names;
}

/// The rows by their CPU time, those that do not reach the error last.
std::vector<const SweepRow*> ranked(const Sweep& sweep) {
    std::vector<const SweepRow*> all;
    for (const SweepRow& row : sweep.rows())
        if (row.result.status != RunStatus::waiting) all.push_back(&row);
    const auto cost = [](const SweepRow& row) {
        return std::isfinite(row.result.cpuSeconds) ? row.result.cpuSeconds : HUGE_VAL;
    };
    std::stable_sort(all.begin(), all.end(), [&](const SweepRow* a, const SweepRow* b) {
        if (a->result.isDone() != b->result.isDone()) return a->result.isDone();
        const bool isByError = !a->result.isDone() || sweep.options().budget > 0;
        if (isByError && sweep.options().budget > 0 && a->result.isDone())
            return isNearer(a->result, b->result);
        return isByError ? a->result.error < b->result.error : cost(*a) < cost(*b);
    });
    return all;
}

std::string counted(int count, const std::string& what) {
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

/// What the wanted error needs of the scheme.
std::string keptOf(const Sweep& sweep, const SweepRow& row) {
    const PointResult& r = row.result;
    if (!r.isDone()) return "";
    std::string text;
    const Reduction has = richnessOf(sweep.scene().schemes[row.point.scheme]),
                    kept = r.reduction.degree > 0 || r.reduction.cells > 0 ? r.reduction : has;
    if (kept.degree > 0)
        text = "degree " + std::to_string(kept.degree) + ", " + counted(kept.nodes, "node") + ", ";
    if (kept.cells > 0) text += counted(kept.cells, "cell") + ", ";
    if (const std::string smaller =
            textOfSmaller(sweep.scene().schemes[row.point.scheme], r.reduction, sweep.scene());
        !smaller.empty())
        text += smaller + ", ";
    if (r.reduction.stepFactor > 0)
        text += "Courant number " + formatNumber(r.reduction.stepFactor, 3) + ", ";
    if (r.reduction.solver > 0) text += "solver to " + formatNumber(r.reduction.solver, 1) + ", ";
    return text + std::to_string(r.steps) + " steps" +
           (r.tolerance > 0 ? ", tolerance " + formatNumber(r.tolerance, 3) : "");
}

/// What of the scene it does without: degrees, nodes, steps, and observables that the metric does not need;
/// and what the smaller scheme saves, against the largest step of the scheme as it is.
std::string leftOutOf(const Sweep& sweep, const SweepRow& row) {
    constexpr double givenUp = 100;
    const bool hasFloor = row.result.floorOf == "mesh";  // which says more
    if (!row.result.isDone() && row.result.timesCheapest >= givenUp && !hasFloor)
        return "given up: would take " + formatNumber(std::floor(row.result.timesCheapest)) + " times the " +
               (sweep.options().repeat == 0 ? "evaluations" : "time") + " of the cheapest";
    if (!row.result.isDone()) return "";
    std::vector<std::string> all;
    if (const Reduction kept = row.result.reduction; kept.cells > 0) {
        const int has = cellsOf(sweep.scene().schemes[row.point.scheme], sweep.scene());
        if (has > kept.cells) all.push_back(std::to_string(has - kept.cells) + " of " + counted(has, "cell"));
    } else if (kept.degree > 0) {
        const Reduction has = richnessOf(sweep.scene().schemes[row.point.scheme]);
        if (has.degree > kept.degree) all.push_back(counted(has.degree - kept.degree, "degree"));
        if (has.nodes > kept.nodes) all.push_back(counted(has.nodes - kept.nodes, "node"));
        const double saved = 1 - workOf(row.result, kept.nodes) / row.result.unreducedWork;
        all.push_back("which saves " + formatNumber(std::round(100 * saved), 3) + " % of the " +
                      (row.result.cost.evaluations > 0 ? "evaluations" : "nodes"));
    }
    const double own = sweep.scene().schemes[row.point.scheme].spec.step.value;
    if (row.result.step > own * 1.01) {
        const double length = sweep.scene().scene.end.value - sweep.scene().scene.start.value;
        const long long before = std::llround(length / own);
        all.push_back(std::to_string(before - row.result.steps) + " of " + std::to_string(before) + " steps");
    }
    for (const std::string& id : sweep.scene().scene.observe)
        if (std::none_of(sweep.metrics().begin(), sweep.metrics().end(),
                         [&](const Metric& m) { return m.reads(id); }))
            all.push_back("observable " + id);
    std::string text;
    for (const std::string& each : all) text += (text.empty() ? "" : "; ") + each;
    return text;
}

/// Of joint wishes: "error 3.1e-7; energy 2e-9".
std::string errorsOf(const Sweep& sweep, const PointResult& r) {
    std::string text;
    for (std::size_t i = 0; i < r.errors.size() && i < sweep.metrics().size(); ++i)
        text += (text.empty() ? "" : "; ") + sweep.metrics()[i].name + ' ' + formatNumber(r.errors[i], 3);
    return text;
}

std::vector<Value::Array> rowsOfPrices(const Sweep& sweep) {
    std::vector<Value::Array> all;
    int rank = 0;
    for (const SweepRow* row : ranked(sweep)) {
        const PointResult& r = row->result;
        all.push_back({r.isDone() ? Value(++rank) : Value(nullptr),
                       sweep.scene().scene.schemes[row->point.scheme].label, positiveNumber(r.step),
                       positiveNumber(r.predictedSeconds), knownNumber(r.cpuSeconds),
                       static_cast<double>(r.cost.evaluations), knownNumber(r.error), keptOf(sweep, *row),
                       leftOutOf(sweep, *row), positiveNumber(r.tolerance), name(r.status),
                       modelInPlace(sweep.scene(), row->point.scheme), knownNumber(r.excess),
                       knownNumber(r.floor), knownText(r.floorOf), knownNumber(r.confirmedAt), r.reason,
                       errorsOf(sweep, r), knownNumber(r.bytes)});
    }
    for (const RefusedCandidate& refused : sweep.refused()) {
        Value::Array row(cheapestColumns().size() + 1, Value(nullptr));
        row[1] = refused.label;
        row[10] = name(RunStatus::failed);
        row[16] = "refused: " + refused.reason;
        all.push_back(std::move(row));
    }
    return all;
}

std::vector<Value::Array> summaryOfPrices(const Sweep& sweep) {
    std::vector<Value::Array> all;
    for (const Value::Array& row : rowsOfPrices(sweep)) {
        if (row[7].isNull()) break;  // the refused ones, of which there are many
        const bool isReached = row[0].isNumber();
        all.push_back({row[0], row[1], row[2], row[3], row[4], row[5], row[6],
                       isReached                   ? row[7]
                       : row[8].asString().empty() ? row[16]
                                                   : row[8],
                       row[9], row[10], row[17]});
        if (isReached && (sweep.options().hasAllCandidates || sweep.options().budget > 0))
            all.back()[7] =
                (row[7].asString().find(" cell") != std::string::npos ? row[7].asString() + "; " : "") +
                row[16].asString();
    }
    return all;
}

}  // namespace

StudyEntry cheapest() {
    StudyEntry e;
    e.item = {
        "cheapest",
        "The cheapest scheme",
        "For a wanted error (--error), or several wishes (--wish), the largest step and the smallest "
        "degree of every scheme that reach it, ranked by CPU time; or for a budget of CPU time (--budget) "
        "the smallest errors. Of the schemes of the scene, or of all that accept it (--candidates all).",
        {},
        {},
        ""};
    e.columns = cheapestColumns();
    e.further = "bytes";
    e.rows = rowsOfPrices;
    e.summaryColumns = {"rank",  "scheme", "step",      "predicted cpu", "cpu seconds", "evaluations",
                        "error", "kept",   "tolerance", "status",        "all errors"};
    e.summary = summaryOfPrices;
    e.summaryPoints = ranked;
    e.over = StudyEntry::Over::wantedError;
    return e;
}

}  // namespace extremal::studies
