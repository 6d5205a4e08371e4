// SPDX-License-Identifier: GPL-3.0-or-later

#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
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
    return runAnswerVerb<SteeringAnswer>(
        scene,
        {.out = given.out,
         .files = {"scene.json", "controls.csv", "states.csv", "steer.json"},
         .inputs = {},
         .doing = "steering",
         .unknown = "no control is known yet",
         .work = [&](const ResolvedScene& resolved,
                     const std::stop_token& stop) { return steer(resolved, given, stop); },
         .document = steeringValue,
         .written =
             [](const SteeringAnswer& answer, const Value& document) {
                 const ReadScene made = readScene(answer.scene);
                 printProblems("steer", made.errors);
                 return AnswerFiles{
                     "steer",
                     document,
                     made.errors.empty() ? writeScene(made.scene) : "",
                     {{"controls.csv", csvText(answer.controls)}, {"states.csv", csvText(answer.states)}}};
             },
         .text = [&](const SteeringAnswer& answer) { return steeringText(answer, given); }},
        options);
}

}  // namespace extremal::app
