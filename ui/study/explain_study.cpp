// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/explain_study.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <variant>

#include "engine/core/text/text.hpp"
#include "ui/base/format.hpp"

namespace extremal {
namespace {

QString say(const char* text) { return QCoreApplication::translate("explain", text); }

/// The unit of what a sweep measures: that of the column its observable declares as its extreme.
std::string unitOfMetric(const Sweep& sweep) { return sweep.metric().unit(); }

QString withReference(const ReferenceInfo& reference) {
    if (reference.description.empty()) return say("The reference is not known yet.");
    QString text = say("Reference: %1.").arg(QString::fromStdString(reference.description));
    if (std::isfinite(reference.estimatedError))
        text += ' ' + say("It is good to %1.").arg(shortNumber(reference.estimatedError));
    return text;
}

QString errorText(const Sweep& sweep) {
    const Metric& metric = sweep.metric();
    const std::string unit = unitOfMetric(sweep);
    const QString where = metric.isAtEnd ? say("at the last node of the run")
                                         : say("the largest over all nodes of the run"),
                  in = unit.empty() ? say("without a unit") : say("in %1").arg(QString::fromStdString(unit));
    const MetricTerm& first = metric.terms.front();
    QString text =
        say("Size of what the observable %1 measures, %2, %3.")
            .arg(QString::fromStdString(first.observable ? first.observable->item.id : first.column), where,
                 in);
    if (metric.name == "error" && metric.isSum)
        text = say("Distance from the reference, %1: of each coordinate over its own size there (1 rad for "
                   "an angle), the root of the mean of their squares.")
                   .arg(where);
    else if (metric.name == "error")
        text = say("Distance from the reference, %1, %2.").arg(where, in);
    else if (metric.isSum || first.hasScale)
        text = say("%1, %2.").arg(QString::fromStdString(metric.name), where);
    if (metric.needsReference()) text += '\n' + withReference(sweep.reference());
    return text;
}

QString timeText(const Sweep& sweep) {
    return say("CPU time of the steps of one run alone, the median of %1 timed runs without observers; what "
               "is prepared once is not in it.")
        .arg(sweep.options().repeat);
}

QString stepText(const Sweep& sweep) {
    const std::string& unit = sweep.scene().system->timeUnit;
    return say("Length of the steps of this run, %1; empty for schemes that choose their steps.")
        .arg(unit.empty() ? say("without a unit") : say("in %1").arg(QString::fromStdString(unit)));
}

/// Of sweeps over steps; by the title of the column.
QString ofSweep(const Sweep& sweep, const std::string& column) {
    const auto is = [&](const char* name) { return column == name; };
    if (is("error")) return errorText(sweep);
    if (is("least error"))
        return say("The smallest error of the runs that reached the end.") + '\n' + errorText(sweep);
    if (is("nearest error"))
        return say("The error measured at the point of the study that the prediction starts from.") + '\n' +
               errorText(sweep);
    if (is("cpu seconds")) return timeText(sweep);
    if (is("nearest cpu"))
        return say("The time measured at the point of the study that the prediction starts from.") + '\n' +
               timeText(sweep);
    if (is("predicted cpu"))
        return say(
            "CPU time of a run that just reaches the wanted error, from the neighbouring points of this "
            "study or from a trial of some steps; not measured.");
    if (is("ratio")) return say("Predicted time over that of the first row.");
    if (is("evaluations"))
        return say("Evaluations of the Lagrangian, its forces or their like in one run, counted.");
    if (is("step")) return stepText(sweep);
    if (is("tolerance"))
        return say("Tolerance of the error control of this run; empty for schemes with a step.");
    if (is("points")) return say("Runs of this scheme that have been made, one for each step of the ladder.");
    if (is("failed")) return say("Runs of those that did not reach the end.");
    if (is("order"))
        return say("Slope of the line through log error over log step, fitted where the points lie on a "
                   "line: "
                   "above round-off and the error of the reference, below the coarsest steps.") +
               '\n' + errorText(sweep);
    if (is("claimed")) return say("The order that the scheme promises on smooth motions; not measured.");
    if (is("from step")) return say("The largest step of the fit of the order.") + '\n' + stepText(sweep);
    if (is("to step")) return say("The smallest step of the fit of the order.") + '\n' + stepText(sweep);
    if (is("rank"))
        return say("Place by the CPU time of the runs that reach the wanted error %1.")
            .arg(shortNumber(sweep.options().wantedError));
    if (is("kept"))
        return say(
            "What the wanted error needs of the scheme, found by a search over steps and degrees; else "
            "why the search ended.");
    if (is("status")) return say("How the run ended.");
    if (is("down to")) return say("The smallest wish that this scheme is the cheapest for.");
    if (is("model"))
        return say("What a reduced model has in place of the system; empty where nothing is left out.");
    if (is("times the one above"))
        return say("What these digits cost, over what the fewer digits above cost.");
    if (is("all errors")) return say("Of joint wishes, the largest value of every metric.");
    if (is("scheme")) return say("The scheme of the scene, by its label.");
    if (is("worth its cost"))
        return say(
            "The scheme of the scene, by its label: no other point of the study is both as accurate and "
            "as cheap.");
    return {};
}

QString nameOf(const VariedNumber& number) { return QString::fromStdString(number.pointer); }

QString ofStability(const StabilityStudy& study, const std::string& column) {
    const QString x = nameOf(study.options().x);
    const auto runs = [&](const char* what) {
        return say("Number of runs over the grid of %1 that end so: %2").arg(x, say(what));
    };
    if (column == "stable")
        return runs(
            "the state stays bounded, and the line through the energy errors rises by at most twice "
            "their scatter.");
    if (column == "drifting")
        return runs(
            "bounded, but the line through the energy errors rises by more than twice their scatter.");
    if (column == "blow-up")
        return runs(
            "the state was not finite, grew to a million times its size at the start, or had left the "
            "motion.");
    if (column == "solver failed") return runs("a step found no solution.");
    if (column == "refused") return runs("the numbers make no valid scene, and no step was taken.");
    if (column == "y")
        return study.options().y ? say("The value of %1, held in this row.").arg(nameOf(*study.options().y))
                                 : say("There is no second number.");
    if (column == "limit")
        return say("The first value of %1 from which whole runs blow up or fail: found on the values of the "
                   "axis, then bisected to four digits between the two numbers beside it.")
            .arg(x);
    if (column == "stable at")
        return say("The value of %1 before the limit at which a run was bounded.").arg(x);
    if (column == "not at")
        return say("The value of %1 beyond the limit at which a run was not bounded.").arg(x);
    return column == "scheme" ? say("The scheme of the scene, by its label.") : QString();
}

QString ofLinear(const LinearStudy&, const std::string& column) {
    const QString test = '\n' + say("h ω, without a unit: the step times the frequency of the test equation, "
                                    "the harmonic oscillator or of wave functions a pair of plane waves.");
    if (column == "stable up to h w")
        return say("The first value from which the largest eigenvalue of the map of one step exceeds 1 by "
                   "more "
                   "than a millionth; none: it does not as far as was looked.") +
               test;
    if (column == "stable at")
        return say("A value below the limit at which the step was found stable.") + test;
    if (column == "not at") return say("A value above the limit at which it was not.") + test;
    if (column == "not measured") return say("Why there is no number.");
    return column == "scheme" ? say("The scheme of the scene, by its label.") : QString();
}

QString ofLimits(const LimitsStudy& study, const std::string& column) {
    const QString wish = '\n' + say("Usable: done, and %1 stays below %2.")
                                    .arg(QString::fromStdString(study.metrics().front().name),
                                         std::isfinite(study.ground().wish) ? shortNumber(study.ground().wish)
                                                                            : say("the wish"));
    if (column == "usable from h") return say("The shortest step of this set that was run.") + wish;
    if (column == "to h") return say("The longest step of this set that was run.") + wish;
    if (column == "shorter steps")
        return say(
            "What ends the set towards shorter steps: accuracy, stability, resonance, the solver, or "
            "the end of the search.");
    if (column == "longer steps")
        return say(
            "What ends the set towards longer steps: accuracy, stability, resonance, the solver, or "
            "the end of the search.");
    if (column == "h omega at most")
        return say(
            "The longest step of the set times the highest frequency of the linearisation along the "
            "reference.");
    if (column == "error there") return say("The error with the longest step of the set.") + wish;
    if (column == "remark") return say("Why there is no usable step.") + wish;
    return column == "scheme" ? say("The scheme of the scene, by its label.") : QString();
}

/// The other columns are classes, counted.
QString ofExtremes(const std::string& column) {
    if (column == "axis") return say("The name of a quantity that goes to its extremes.");
    if (column == "what varies")
        return say("What varies along the axis, in scenes that the study makes itself.");
    const QString count =
        say("Number of cases of the axis, a run of one scheme at one value each, with this "
            "outcome: ");
    if (column == "right")
        return count + say("done, with a measure of at most 0.1: the error relative to the "
                           "start, or the change of the energy or the norm.");
    if (column == "coarse") return count + say("done and bounded, with a larger measure.");
    return count + say("%1.").arg(QString::fromStdString(column));
}

}  // namespace

QString explainStudyCell(const AnyStudy& study, const std::string& column, const Value& value) {
    QString text;
    if (const auto* sweep = std::get_if<Sweep>(&study))
        text = ofSweep(*sweep, column);
    else if (const auto* stability = std::get_if<StabilityStudy>(&study))
        text = ofStability(*stability, column);
    else if (const auto* linear = std::get_if<LinearStudy>(&study))
        text = ofLinear(*linear, column);
    else if (const auto* limits = std::get_if<LimitsStudy>(&study))
        text = ofLimits(*limits, column);
    else
        text = ofExtremes(column);
    if (text.isEmpty()) return text;
    if (value.isNumber())
        return text + '\n' + say("In full: %1.").arg(QString::fromStdString(formatNumber(value.asNumber())));
    return value.isNull()
               ? text + '\n' + say("The cell is empty: the number is not known, or nothing was counted.")
               : text;
}

}  // namespace extremal
