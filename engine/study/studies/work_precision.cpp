// SPDX-License-Identifier: GPL-3.0-or-later
/// What accuracy costs: work-precision.csv.
#include <algorithm>

#include "engine/core/known_value.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/search/pareto.hpp"

namespace extremal::studies {
namespace {

std::vector<Value::Array> rowsOfWork(const Sweep& sweep) {
    std::vector<Value::Array> all;
    const std::vector<SweepRow>& rows = sweep.rows();
    const std::vector<bool> front = paretoFront(sweep);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [point, result] = rows[i];
        if (result.status == RunStatus::waiting) continue;
        all.push_back({sweep.scene().scene.schemes[point.scheme].label, positiveNumber(point.step),
                       positiveNumber(point.tolerance), knownNumber(result.error),
                       knownNumber(result.cpuSeconds), knownNumber(result.cpuSpread),
                       static_cast<double>(result.cost.evaluations),
                       static_cast<double>(result.cost.linearSolves), name(result.status),
                       knownText(name(result.cause)), front[i], positiveNumber(cellsAt(sweep, point))});
    }
    return all;
}

/// What is worth its cost, the cheapest first.
std::vector<const SweepRow*> frontOf(const Sweep& sweep) {
    const std::vector<SweepRow>& rows = sweep.rows();
    const std::vector<bool> front = paretoFront(sweep);
    std::vector<const SweepRow*> best;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (front[i]) best.push_back(&rows[i]);
    std::sort(best.begin(), best.end(), [](const SweepRow* a, const SweepRow* b) {
        return a->result.cpuSeconds < b->result.cpuSeconds;
    });
    return best;
}

std::vector<Value::Array> summaryOfWork(const Sweep& sweep) {
    std::vector<Value::Array> all;
    for (const SweepRow* row : frontOf(sweep))
        all.push_back({sweep.scene().scene.schemes[row->point.scheme].label, positiveNumber(row->point.step),
                       positiveNumber(row->point.tolerance), knownNumber(row->result.error),
                       knownNumber(row->result.cpuSeconds),
                       static_cast<double>(row->result.cost.evaluations)});
    return all;
}

}  // namespace

StudyEntry work_precision() {
    StudyEntry e;
    e.item = {"work-precision",
              "Work and precision",
              "Errors against CPU time and evaluations over a ladder of steps, with the Pareto front.",
              {},
              {},
              ""};
    e.columns = {"label",       "step",          "tolerance", "error", "cpu_seconds", "cpu_spread",
                 "evaluations", "linear_solves", "status",    "cause", "pareto"};
    e.further = "cells";
    e.rows = rowsOfWork;
    e.summaryColumns = {"worth its cost", "step", "tolerance", "error", "cpu seconds", "evaluations"};
    e.summary = summaryOfWork;
    e.summaryPoints = frontOf;
    return e;
}

}  // namespace extremal::studies
