// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene needs: for each of a ladder of wishes the cheapest of all schemes, what it leaves out and
/// what the next rung would cost: needs.csv.
#include <algorithm>
#include <cmath>

#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/search/term_costs.hpp"
#include "engine/study/model_in_place.hpp"

namespace extremal::studies {
namespace {

std::string textOfSteps(const Sweep& sweep, const SweepRow& row) {
    const PointResult& r = row.result;
    const Reduction has = richnessOf(schemeOf(sweep.scene(), row.point));
    std::string text = has ? "degree " + std::to_string(has.degree) + ", " : "";
    if (r.reduction.cells > 0) text += std::to_string(r.reduction.cells) + " cells, ";
    if (const std::string smaller =
            textOfSmaller(sweep.scene().schemes[row.point.scheme], r.reduction, sweep.scene());
        !smaller.empty())
        text += smaller + ", ";
    return text + std::to_string(r.steps) + " steps" +
           (r.tolerance > 0 ? ", tolerance " + formatNumber(r.tolerance, 3) : "");
}

/// How many times what a rung costs the next lower wish takes; unknown where it is the last, or not reached.
double timesOfNext(const Sweep& sweep, std::size_t i) {
    if (i + 1 >= sweep.rows().size()) return PointResult::unknown;
    const PointResult &own = sweep.answer(i).result, &next = sweep.answer(i + 1).result;
    return own.isDone() && next.isDone() ? next.cpuSeconds / own.cpuSeconds : PointResult::unknown;
}

std::vector<Value::Array> rungs(const Sweep& sweep) {
    std::vector<Value::Array> all;
    for (std::size_t i = 0; i < sweep.rows().size(); ++i) {
        const SweepRow& row = sweep.answer(i);
        const PointResult& r = row.result;
        if (r.status == RunStatus::waiting) continue;
        all.push_back({sweep.options().rungs[i], sweep.scene().scene.schemes[row.point.scheme].label,
                       modelInPlace(sweep.scene(), row.point.scheme),
                       r.isDone() ? textOfSteps(sweep, row) : "", knownNumber(r.cpuSeconds),
                       knownNumber(r.error), knownNumber(r.floor), knownText(r.floorOf),
                       positiveNumber(r.step), positiveNumber(r.tolerance), static_cast<double>(r.steps),
                       static_cast<double>(r.cost.evaluations), knownNumber(timesOfNext(sweep, i)),
                       name(r.status), r.reason, knownNumber(r.bytes)});
    }
    return all;
}

/// Rungs with the same answer are one: the finest of them serves them all; of those that were not reached the
/// first.
std::vector<const SweepRow*> joined(const Sweep& sweep) {
    std::vector<const SweepRow*> all;
    for (std::size_t i = 0; i < sweep.rows().size(); ++i) {
        const SweepRow& row = sweep.answer(i);
        if (row.result.status == RunStatus::waiting) continue;
        const bool isSame = !all.empty() && all.back()->point.scheme == row.point.scheme &&
                            all.back()->result.isDone() == row.result.isDone();
        if (!isSame)
            all.push_back(&row);
        else if (row.result.isDone())
            all.back() = &row;
    }
    return all;
}

std::vector<Value::Array> summaryOfRungs(const Sweep& sweep) {
    std::vector<Value::Array> all;
    double before = 0;
    for (const SweepRow* row : joined(sweep)) {
        const PointResult& r = row->result;
        const double wish = sweep.options().rungs[static_cast<std::size_t>(row - sweep.rows().data())];
        const std::string model = modelInPlace(sweep.scene(), row->point.scheme);
        all.push_back({wish, sweep.scene().scene.schemes[row->point.scheme].label,
                       model.empty() ? Value(nullptr) : Value(model),
                       r.isDone() ? textOfSteps(sweep, *row) : "not reached: " + r.reason,
                       r.isDone() ? knownNumber(r.cpuSeconds) : Value(nullptr), knownNumber(r.error),
                       r.isDone() && before > 0 ? Value(r.cpuSeconds / before) : Value(nullptr)});
        if (r.isDone()) before = r.cpuSeconds;
    }
    return all;
}

/// What may be left out of the formula itself.
std::vector<StudyTable> tableOfTerms(const Sweep& sweep) {
    StudyTable table{"needs-terms", {"term", "first_order", "measured", "may_go_above"}, {}};
    for (const TermCost& cost : sweep.terms())
        table.rows.push_back({cost.term, knownNumber(cost.firstOrder), knownNumber(cost.measured),
                              knownNumber(TermCost::safety * cost.firstOrder)});
    return table.rows.empty() ? std::vector<StudyTable>{} : std::vector<StudyTable>{std::move(table)};
}

}  // namespace

StudyEntry needs() {
    StudyEntry e;
    e.item = {
        "needs",
        "What the scene needs",
        "For each of a ladder of wishes, from 0.1 down to 1e-12, the cheapest of all schemes that accept "
        "the scene: what may be left out, and what the next digits cost.",
        {},
        {},
        ""};
    e.over = StudyEntry::Over::wishes;
    e.columns = {"wish", "label",     "model", "knobs",       "cpu_seconds",   "error",  "floor", "floor_of",
                 "step", "tolerance", "steps", "evaluations", "times_of_next", "status", "reason"};
    e.further = "bytes";
    e.rows = rungs;
    e.summaryColumns = {"down to", "scheme", "model", "kept", "cpu seconds", "error", "times the one above"};
    e.summary = summaryOfRungs;
    e.summaryPoints = joined;
    e.besides = tableOfTerms;
    return e;
}

}  // namespace extremal::studies
