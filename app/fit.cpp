// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/studies/fit_figure.hpp"
#include "engine/figure/image/svg.hpp"
#include "engine/study/fit/fit.hpp"
#include "engine/study/fit/measured_data.hpp"

namespace extremal::app {
namespace {

std::string known(double value, int digits) {
    return std::isfinite(value) ? formatNumber(value, digits) : "not seen";
}

std::string fitText(const FitAnswer& answer) {
    Table table;
    table.isRightAligned = {false, true, true, true, true};
    table.rows.push_back({"number", "start", "value", "deviation", "bias of the step"});
    for (const FittedNumber& each : answer.numbers)
        table.rows.push_back({each.name, formatNumber(each.start, 6), formatNumber(each.value, 9),
                              known(each.deviation, 3),
                              std::isfinite(each.bias) ? formatNumber(each.bias, 2) : ""});
    std::string text = answer.scheme + ": " + std::to_string(answer.measurements) + " measurements, " +
                       std::to_string(answer.sums.size() - 1) + " steps, sum of squares " +
                       formatNumber(answer.sums.front(), 4) + " to " + formatNumber(answer.sums.back(), 4) +
                       ", scatter " + formatNumber(answer.scatter, 3) +
                       (answer.hasDeviations ? " of the given deviations" : "") + "\n\n" + table.text();
    for (const std::string& note : answer.notes) text += "\n" + note + "\n";
    return text;
}

}  // namespace

int fitVerb(const std::string& scene, const FitOptions& given, const CommonOptions& options) {
    return runAnswerVerb<FitAnswer>(
        scene,
        {.out = given.out,
         .files = {"scene.json", "parameters.csv", "residuals.csv", "residuals.svg", "fit.json"},
         .inputs = {given.data},
         .doing = "fitting",
         .unknown = "no minimum is known yet",
         .work =
             [&](const ResolvedScene& resolved, const std::stop_token& stop) {
                 const MeasuredData data = readMeasuredFile(given.data, *resolved.system, given.columns);
                 return fit(resolved, data, given, stop);
             },
         .document = fitValue,
         .written =
             [](const FitAnswer& answer, const Value& document) {
                 return AnswerFiles{"fit",
                                    document,
                                    writeScene(readScene(answer.scene).scene),
                                    {{"parameters.csv", csvText(numbersTable(answer))},
                                     {"residuals.csv", csvText(answer.residuals)},
                                     {"residuals.svg", svgOf(residualsFigure(answer))}}};
             },
         .text = fitText},
        options);
}

}  // namespace extremal::app
