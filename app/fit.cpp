// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>

#include "app/load.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/fit_figure.hpp"
#include "engine/figure/image/svg.hpp"
#include "engine/run/files/answer_files.hpp"
#include "engine/scene/read/json.hpp"
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
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    return guarded(sceneName(scene), [&] {
        const Replacing replacing = replacingOf(scene, read, options, {given.data});
        for (const char* file : {"scene.json", "fit.json"})
            requireReplaceable(std::filesystem::path(given.out) / file, replacing);
        const MeasuredData data = readMeasuredFile(given.data, *read.resolved->system, given.columns);
        InterruptWatch watch;
        FitAnswer answer;
        const bool isInterrupted =
            workAndWait([&](const std::stop_token& stop) { answer = fit(*read.resolved, data, given, stop); },
                        [] { return 0.0; }, [] { return std::string("fitting"); }, watch, options);
        if (isInterrupted) {
            printProblem("", "interrupted: no minimum is known yet");
            return static_cast<int>(interrupted);
        }
        const Value document = fitValue(answer);
        if (!answer.isFound()) {
            printProblem(sceneName(scene) + ": " + answer.scheme, answer.problem, answer.remedy);
            return options.isJson ? print(writeJson(document), failed) : static_cast<int>(failed);
        }
        writeAnswer({"fit",
                     document,
                     writeScene(readScene(answer.scene).scene),
                     {{"parameters.csv", csvText(numbersTable(answer))},
                      {"residuals.csv", csvText(answer.residuals)},
                      {"residuals.svg", svgOf(residualsFigure(answer))}}},
                    given.out, replacing);
        if (options.isJson) return print(writeJson(document), done);
        if (options.isQuiet) return static_cast<int>(done);
        return print(fitText(answer) +
                         "\nscene.json, parameters.csv, residuals.csv, residuals.svg and fit.json in " +
                         given.out + "\n",
                     done);
    });
}

}  // namespace extremal::app
