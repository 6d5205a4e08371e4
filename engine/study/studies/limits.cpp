// SPDX-License-Identifier: GPL-3.0-or-later
/// How large h may be on the scene: limits.csv.
#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {
namespace {

std::string labelOf(const LimitsStudy& study, const LimitsStudy::Row& row) {
    return study.scene().scene.schemes[row.scheme].label;
}

Value times(double h, double omega) { return omega > 0 ? Value(h * omega) : Value(nullptr); }

Value::Array rowOf(const LimitsStudy& study, const LimitsStudy::Row& row, const StepRange& range) {
    const LimitsStudy::Ground& g = study.ground();
    return {labelOf(study, row),
            range.from,
            range.to,
            knownText(name(range.judgement)),
            knownText(name(range.reason)),
            range.isUsable() ? knownText(name(range.below)) : Value(nullptr),
            range.isUsable() ? knownText(name(range.above)) : Value(nullptr),
            times(range.from, g.omegaHigh),
            times(range.to, g.omegaHigh),
            knownNumber(range.errorFrom),
            knownNumber(range.errorTo),
            positiveNumber(g.omegaLow),
            positiveNumber(g.omegaHigh),
            knownNumber(g.wish),
            knownNumber(g.floor)};
}

/// "no usable step: accuracy, solver"; where the search had to end before, down to which step.
std::string whyNot(const UsableSteps& steps) {
    std::string text;
    for (const StepRange& range : steps.ranges) {
        const std::string why(name(range.reason));
        if (!why.empty() && text.find(why) == std::string::npos) text += (text.empty() ? "" : ", ") + why;
    }
    if (text.empty()) return "no step was tried in the time of the search";
    const StepRange& shortest = steps.ranges.front();
    const bool isTimeUp = shortest.below == StepLimit::time;
    return "no usable step" +
           (isTimeUp ? " down to " + formatNumber(shortest.from, 3) + ", where its time ended" : "") + ": " +
           text;
}

}  // namespace

std::vector<StudyTable> tablesOf(const StudyEntry& study, const LimitsStudy& limits) {
    StudyTable table{study.item.id, study.columns, {}};
    for (const LimitsStudy::Row& row : limits.rows()) {
        if (!row.isKnown) continue;
        for (const StepRange& range : row.result.ranges) table.rows.push_back(rowOf(limits, row, range));
        if (row.result.ranges.empty()) {
            Value::Array none(study.columns.size(), Value(nullptr));
            none[0] = labelOf(limits, row);
            none[4] = row.result.reason;
            table.rows.push_back(std::move(none));
        }
    }
    return {std::move(table)};
}

/// One row per usable set.
StudyTable summaryOf(const StudyEntry&, const LimitsStudy& limits) {
    StudyTable table{"",
                     {"scheme", "usable from h", "to h", "shorter steps", "longer steps", "h omega at most",
                      "error there", "remark"},
                     {}};
    for (const LimitsStudy::Row& row : limits.rows()) {
        if (!row.isKnown) continue;
        bool isAny = false;
        for (const StepRange& range : row.result.ranges) {
            if (!range.isUsable()) continue;
            isAny = true;
            table.rows.push_back({labelOf(limits, row), range.from, range.to, knownText(name(range.below)),
                                  knownText(name(range.above)), times(range.to, limits.ground().omegaHigh),
                                  knownNumber(range.errorTo), Value(nullptr)});
        }
        if (isAny) continue;
        Value::Array none(table.columns.size(), Value(nullptr));
        none.front() = labelOf(limits, row);
        none.back() = row.result.reason.empty() ? whyNot(row.result) : row.result.reason;
        table.rows.push_back(std::move(none));
    }
    return table;
}

namespace studies {

StudyEntry limits() {
    StudyEntry e;
    e.item = {"limits",
              "How large may h be?",
              "Of every scheme the steps that are usable on the scene for the wishes (--wish), which need "
              "not be all below one limit, and what ends them on either side: accuracy, stability, "
              "resonance or the solver.",
              {},
              {},
              ""};
    e.over = StudyEntry::Over::usableSteps;
    e.columns = {"label",      "from",       "to",           "class",      "reason",
                 "ends_below", "ends_above", "h_omega_from", "h_omega_to", "error_from",
                 "error_to",   "omega_low",  "omega_high",   "wish",       "floor"};
    return e;
}

}  // namespace studies
}  // namespace extremal
