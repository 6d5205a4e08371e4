// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/load.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/answer_files.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/gradient/gradient.hpp"

namespace extremal::app {
namespace {

std::string gradientText(const GradientAnswer& answer) {
    constexpr std::size_t mostRows = 40;
    Table table;
    table.isRightAligned = {false, true, true};
    table.rows.push_back({"number", "value", "derivative"});
    for (std::size_t i = 0; i < std::min(mostRows, answer.rows.size()); ++i) {
        const GradientRow& row = answer.rows[i];
        table.rows.push_back({row.name, std::isfinite(row.value) ? formatNumber(row.value, 9) : "",
                              formatNumber(row.derivative, 13)});
    }
    std::string text = answer.scheme + ", " + std::to_string(answer.steps) +
                       " steps: " + formatNumber(answer.value, 13) + " (at the end " +
                       formatNumber(answer.atEnd, 13) + ", integral " + formatNumber(answer.integral, 13) +
                       ")\n\n" + table.text();
    if (answer.rows.size() > mostRows)
        text += "and " + std::to_string(answer.rows.size() - mostRows) + " more in gradient.csv\n";
    return text;
}

}  // namespace

int gradientVerb(const std::string& scene, const GradientOptions& given, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    return guarded(sceneName(scene), [&] {
        const Replacing replacing = replacingOf(scene, read, options);
        for (const char* file : {"gradient.csv", "gradient.json"})
            requireReplaceable(std::filesystem::path(given.out) / file, replacing);
        InterruptWatch watch;
        GradientAnswer answer;
        const bool isInterrupted =
            workAndWait([&](const std::stop_token& stop) { answer = gradient(*read.resolved, given, stop); },
                        [] { return 0.0; }, [] { return std::string("differentiating"); }, watch, options);
        if (isInterrupted) {
            printProblem("", "interrupted: no gradient is known yet");
            return static_cast<int>(interrupted);
        }
        const Value document = gradientValue(answer);
        if (!answer.isFound()) {
            printProblem(sceneName(scene) + ": " + answer.scheme, answer.problem, answer.remedy);
            return options.isJson ? print(writeJson(document), failed) : static_cast<int>(failed);
        }
        writeAnswer({"gradient", document, "", {{"gradient.csv", csvText(gradientTable(answer))}}}, given.out,
                    replacing);
        if (options.isJson) return print(writeJson(document), done);
        if (options.isQuiet) return static_cast<int>(done);
        return print(gradientText(answer) + "\ngradient.csv and gradient.json in " + given.out + "\n", done);
    });
}

}  // namespace extremal::app
