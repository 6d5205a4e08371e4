// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
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
    return runAnswerVerb<GradientAnswer>(
        scene,
        {.out = given.out,
         .files = {"gradient.csv", "gradient.json"},
         .inputs = {},
         .doing = "differentiating",
         .unknown = "no gradient is known yet",
         .work = [&](const ResolvedScene& resolved,
                     const std::stop_token& stop) { return gradient(resolved, given, stop); },
         .document = gradientValue,
         .written =
             [](const GradientAnswer& answer, const Value& document) {
                 return AnswerFiles{
                     "gradient", document, "", {{"gradient.csv", csvText(gradientTable(answer))}}};
             },
         .text = gradientText},
        options);
}

}  // namespace extremal::app
