// SPDX-License-Identifier: GPL-3.0-or-later
/// Which scheme is cheapest for a wanted error: cheapest.csv.
#include <algorithm>
#include <cmath>

#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/catalog.hpp"

namespace extremal::studies {
namespace {

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
        return a->result.isDone() ? cost(*a) < cost(*b) : a->result.error < b->result.error;
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
                    kept = r.reduction ? r.reduction : has;
    if (kept) text = "degree " + std::to_string(kept.degree) + ", " + counted(kept.nodes, "node") + ", ";
    return text + std::to_string(r.steps) + " steps" +
           (r.tolerance > 0 ? ", tolerance " + formatNumber(r.tolerance, 3) : "");
}

/// What of the scene it does without: degrees, nodes, steps, and observables that the metric does not need;
/// and what the smaller scheme saves, against the largest step of the scheme as it is.
std::string leftOutOf(const Sweep& sweep, const SweepRow& row) {
    if (row.result.timesCheapest > 0)
        return "given up: would take " + formatNumber(std::floor(row.result.timesCheapest)) +
               " times the evaluations of the cheapest, or more";
    if (!row.result.isDone()) return "";
    std::vector<std::string> all;
    if (const Reduction kept = row.result.reduction; kept) {
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
        if (id != sweep.metric().observable->item.id) all.push_back("observable " + id);
    std::string text;
    for (const std::string& each : all) text += (text.empty() ? "" : "; ") + each;
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
                       leftOutOf(sweep, *row), positiveNumber(r.tolerance), name(r.status)});
    }
    return all;
}

std::vector<Value::Array> summaryOfPrices(const Sweep& sweep) {
    std::vector<Value::Array> all = rowsOfPrices(sweep);
    for (Value::Array& row : all) {
        if (row[7].asString().empty()) row[7] = row[8];  // why nothing is kept
        row.erase(row.begin() + 8);                      // what is left out is long
    }
    return all;
}

}  // namespace

StudyEntry cheapest() {
    StudyEntry e;
    e.item = {"cheapest",
              "The cheapest scheme",
              "For a wanted error (--error), the largest step and the smallest degree of every scheme that "
              "reach it, ranked by CPU time.",
              {},
              {},
              ""};
    e.columns = {"rank",        "label",       "step",  "predicted_cpu_seconds",
                 "cpu_seconds", "evaluations", "error", "kept",
                 "left_out",    "tolerance",   "status"};
    e.rows = rowsOfPrices;
    e.summaryColumns = {"rank",        "scheme", "step", "predicted cpu", "cpu seconds",
                        "evaluations", "error",  "kept", "tolerance",     "status"};
    e.summary = summaryOfPrices;
    e.summaryPoints = ranked;
    e.over = StudyEntry::Over::wantedError;
    return e;
}

}  // namespace extremal::studies
