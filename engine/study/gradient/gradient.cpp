// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/gradient/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/core/algebra/interpolant.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/gradient/end_function.hpp"
#include "engine/study/gradient/run_derivative.hpp"

namespace extremal {
namespace {

const std::string controlPlace = "/model/controls/";

/// A control by a table, on the steps of a run.
struct TableOnSteps {
    std::string name, pointer;
    std::vector<double> t, u;  ///< of its rows

    /// The rows at both sides of a time, and the part of the second; outside the table its end alone.
    struct Between {
        std::size_t row;
        double part;
    };
    Between between(double time) const {
        const auto above = std::upper_bound(t.begin(), t.end(), time);
        if (above == t.begin()) return {0, 0};
        if (above == t.end()) return {t.size() - 2, 1};
        const auto row = static_cast<std::size_t>(above - t.begin()) - 1;
        return {row, (time - t[row]) / (t[row + 1] - t[row])};
    }
    void add(double time, double derivative, std::vector<double>& byRows) const {
        const Between place = between(time);
        byRows[place.row] += (1 - place.part) * derivative;
        byRows[place.row + 1] += place.part * derivative;
    }
};

TableOnSteps tableAt(const Value& document, const std::string& pointer) {
    TableOnSteps made;
    made.pointer = pointer;
    made.name = pointer.substr(controlPlace.size());
    const Value* const control = valueAt(document, pointer);
    if (!control)
        throw InvalidScene("--with", pointer + " is not in the scene", "the name of a control of the model");
    const Value* const table = control->isObject() ? control->find("table") : nullptr;
    const Value* const kind = control->isObject() ? control->find("interpolation") : nullptr;
    if (!table || (kind && *kind != Value("linear")))
        throw InvalidScene("--with", pointer + " is not a table of straight lines",
                           R"({"table": [[0, 1], [1, 0]], "interpolation": "linear"}, or the parameters of )"
                           "its formula");
    for (const Value& row : table->asArray()) {
        made.t.push_back(row.asArray()[0].asNumber());
        made.u.push_back(row.asArray()[1].asNumber());
    }
    return made;
}

/// Corners inside a step cannot be followed by a straight line on it.
void requireRowsAtSteps(const TableOnSteps& table, const std::vector<double>& times) {
    constexpr double same = 1e-6;
    const double first = std::min(times.front(), times.back()), last = std::max(times.front(), times.back()),
                 h = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    for (const double t : table.t) {
        const double k = (t - times.front()) / h;
        if (t > first && t < last && std::abs(k - std::round(k)) > same)
            throw InvalidScene("--with",
                               table.pointer + " has a row at t = " + formatNumber(t, 6) +
                                   ", which is not the end of a step of " + formatNumber(std::abs(h), 6),
                               "rows at ends of steps, or a step that reaches them");
    }
}

struct GradientParts {
    RunDerivative::Request run;
    std::vector<TableOnSteps> tables;
};
GradientParts partsOf(const GradientRequest& request, const Value& document) {
    if (request.of.empty() && request.over.empty())
        throw InvalidScene("--of", "or --over must say what is differentiated",
                           "--of 'x^2 + y^2' at the end, --over 'x^2' for an integral over the run");
    if (request.with.empty())
        throw InvalidScene("--with", "names no number", "for example --with /model/k,/initial/q/0");
    GradientParts parts;
    parts.run.scheme = request.scheme;
    parts.run.integrand = request.over;
    std::set<std::string> seen;
    for (const std::string& pointer : request.with) {
        if (!seen.insert(pointer).second) throw InvalidScene("--with", pointer + " is there twice", "once");
        if (!pointer.starts_with(controlPlace)) {
            parts.run.pointers.push_back(pointer);
            continue;
        }
        parts.tables.push_back(tableAt(document, pointer));
        parts.run.controls.emplace_back(parts.tables.back().name, 2);
    }
    if (parts.run.pointers.size() > mostVariedNumbers)
        throw InvalidScene("--with", "takes at most " + std::to_string(mostVariedNumbers) +
                                         " numbers besides controls, got " +
                                         std::to_string(parts.run.pointers.size()));
    return parts;
}

void addTableRows(const TableOnSteps& table, const Eigen::MatrixXd& byCoefficients, Eigen::Index first,
                  const std::vector<double>& times, GradientAnswer& answer) {
    std::vector<double> byRows(table.t.size(), 0.0);
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const double mean = byCoefficients(first, column), slope = byCoefficients(first + 1, column);
        table.add(times[k], mean / 2 - slope, byRows);
        table.add(times[k + 1], mean / 2 + slope, byRows);
    }
    for (std::size_t i = 0; i < byRows.size(); ++i)
        answer.rows.push_back({table.name + "." + std::to_string(i),
                               table.pointer + "/table/" + std::to_string(i) + "/1", table.u[i], byRows[i]});
}

double valueOf(const Value& document, const std::string& pointer) {
    const Value* const given = valueAt(document, pointer);
    return given && given->isNumber() ? given->asNumber() : std::nan("");
}

}  // namespace

GradientAnswer gradient(const ResolvedScene& scene, const GradientRequest& request,
                        const std::stop_token& stop) {
    const Value document = toValue(scene.scene);
    const GradientParts parts = partsOf(request, document);
    RunDerivative run(scene, parts.run);
    const std::vector<double>& times = run.times();
    Eigen::MatrixXd c(run.coefficients(), run.steps());
    for (std::size_t i = 0; i < parts.tables.size(); ++i) {
        const TableOnSteps& table = parts.tables[i];
        requireRowsAtSteps(table, times);
        const Interpolant curve(Interpolant::Kind::linear, table.t, table.u);
        const auto row = static_cast<Eigen::Index>(2 * i);
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            const double a = curve.at(times[k]), b = curve.at(times[k + 1]);
            c(row, static_cast<Eigen::Index>(k)) = (a + b) / 2;
            c(row + 1, static_cast<Eigen::Index>(k)) = b - a;
        }
    }
    const EndFunction F(request.of, "--of", run);
    GradientAnswer answer;
    answer.scheme = run.scheme();
    answer.steps = run.steps();
    const auto isDone = [&](Outcome outcome) {
        if (outcome == Outcome::converged) return true;
        answer.problem = "a step at t = " + formatNumber(run.failedAt(), 4) + " " +
                         (outcome == Outcome::refused ? "does more than go on, and has no tangent map"
                                                      : "fails: " + std::string(name(outcome)));
        answer.remedy = "an earlier end, or a smaller step";
        return false;
    };
    if (!isDone(run.run(run.start(), c, stop))) return answer;
    const EndFunction::Values at = F.at(run.end());
    answer.atEnd = at.value;
    answer.integral = run.integral();
    answer.value = answer.atEnd + answer.integral;
    RunDerivative::Derivatives by;
    if (!isDone(run.differentiate(run.columnOf(at.byState, 1, at.byParameters), by))) return answer;
    answer.statesKept = run.kept();
    for (std::size_t i = 0; i < parts.run.pointers.size(); ++i)
        answer.rows.push_back({run.numbers()[i].name, parts.run.pointers[i],
                               valueOf(document, parts.run.pointers[i]),
                               by.byNumbers(static_cast<Eigen::Index>(i), 0)});
    for (std::size_t i = 0; i < parts.tables.size(); ++i)
        addTableRows(parts.tables[i], by.byCoefficients.front(), static_cast<Eigen::Index>(2 * i), times,
                     answer);
    return answer;
}

StudyTable gradientTable(const GradientAnswer& answer) {
    StudyTable table{"gradient", {"name", "pointer", "value", "derivative"}, {}};
    for (const GradientRow& row : answer.rows)
        table.rows.push_back(
            {row.name, row.pointer, std::isfinite(row.value) ? Value(row.value) : Value(), row.derivative});
    return table;
}

Value gradientValue(const GradientAnswer& answer) {
    Value document{Value::Object{}};
    document.set("found", answer.isFound());
    document.set("scheme", answer.scheme);
    document.set("steps", static_cast<double>(answer.steps));
    if (!answer.isFound()) {
        document.set("problem", answer.problem);
        document.set("remedy", answer.remedy);
        return document;
    }
    document.set("value", answer.value);
    document.set("at_end", answer.atEnd);
    document.set("integral", answer.integral);
    document.set("states_kept", static_cast<double>(answer.statesKept));
    Value::Array rows;
    for (const GradientRow& row : answer.rows) {
        Value each{Value::Object{}};
        each.set("name", row.name);
        each.set("pointer", row.pointer);
        each.set("value", std::isfinite(row.value) ? Value(row.value) : Value());
        each.set("derivative", row.derivative);
        rows.push_back(std::move(each));
    }
    document.set("gradient", std::move(rows));
    return document;
}

}  // namespace extremal
