// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "app/load.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/answer_files.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/gradient/steering.hpp"

namespace extremal::app {
namespace {

std::string steeringText(const SteeringAnswer& answer, const SteeringRequest& request) {
    std::string text = answer.scheme + ", " + std::to_string(answer.steps) + " steps: cost " +
                       formatNumber(answer.cost, 14) + " after " + std::to_string(answer.iterations) +
                       (answer.iterations == 1 ? " iteration" : " iterations") + ", slope " +
                       formatNumber(answer.slope, 2) + ", conditions missed by " +
                       formatNumber(answer.miss, 2) + "\n";
    if (answer.atBounds > 0) text += std::to_string(answer.atBounds) + " values at their bounds\n";
    if (answer.multipliers.empty()) return text;
    Table table;
    table.isRightAligned = {false, true};
    table.rows.push_back({"condition", "multiplier"});
    for (std::size_t j = 0; j < answer.multipliers.size(); ++j)
        table.rows.push_back({request.conditions[j] + " = 0", formatNumber(answer.multipliers[j], 12)});
    return text + "\n" + table.text();
}

}  // namespace

int steerVerb(const std::string& scene, const SteerOptions& given, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    return guarded(sceneName(scene), [&] {
        const Replacing replacing = replacingOf(scene, read, options);
        for (const char* file : {"scene.json", "controls.csv", "states.csv", "steer.json"})
            requireReplaceable(std::filesystem::path(given.out) / file, replacing);
        InterruptWatch watch;
        SteeringAnswer answer;
        const bool isInterrupted =
            workAndWait([&](const std::stop_token& stop) { answer = steer(*read.resolved, given, stop); },
                        [] { return 0.0; }, [] { return std::string("steering"); }, watch, options);
        if (isInterrupted) {
            printProblem("", "interrupted: no control is known yet");
            return static_cast<int>(interrupted);
        }
        const Value document = steeringValue(answer);
        if (!answer.isFound()) {
            printProblem(sceneName(scene) + ": " + answer.scheme, answer.problem, answer.remedy);
            return options.isJson ? print(writeJson(document), failed) : static_cast<int>(failed);
        }
        const ReadScene made = readScene(answer.scene);
        printProblems("steer", made.errors);
        writeAnswer({"steer",
                     document,
                     made.errors.empty() ? writeScene(made.scene) : "",
                     {{"controls.csv", csvText(answer.controls)}, {"states.csv", csvText(answer.states)}}},
                    given.out, replacing);
        if (options.isJson) return print(writeJson(document), done);
        if (options.isQuiet) return static_cast<int>(done);
        return print(steeringText(answer, given) +
                         "\nscene.json, controls.csv, states.csv and steer.json in " + given.out + "\n",
                     done);
    });
}

}  // namespace extremal::app
