// SPDX-License-Identifier: GPL-3.0-or-later
/// |H(t) - H(0)| on a logarithmic axis; says how many schemes drift (trend.hpp).
#include <algorithm>
#include <cmath>

#include "engine/figure/against.hpp"
#include "engine/figure/trend.hpp"
#include "engine/model/conservative.hpp"

namespace extremal::recipes {
namespace {

/// "no drift: 3 of 5, drift: 1, too short to tell: 1"; empty where no scheme has values. `scale`: of the
/// energy, to which round-off is relative.
std::string trendsOf(const Comparison& comparison, double scale) {
    constexpr std::size_t fewest = 8;  // rows
    int all = 0, steady = 0, drifting = 0, open = 0, failed = 0;
    for (const auto& scheme : comparison.schemes) {
        const auto error = scheme->trajectory["energy_error"];
        if (error.size() < fewest) continue;
        ++all;
        if (scheme->summary.status == RunStatus::failed) {
            ++failed;
            continue;
        }
        // Round-off adds up like a random walk, of some tens of units in each step.
        const double steps = static_cast<double>(std::max<long long>(0, scheme->summary.steps));
        const double noise = 0x1p-52 * scale * std::max(1e3, 30 * std::sqrt(steps));
        const Trend trend = trendOf(error, noise);
        (trend == Trend::none ? steady : trend == Trend::drift ? drifting : open) += 1;
    }
    if (all == 0) return {};
    std::string text = "no drift: " + std::to_string(steady) + " of " + std::to_string(all);
    if (drifting > 0) text += ", drift: " + std::to_string(drifting);
    if (open > 0) text += ", too short to tell: " + std::to_string(open);
    if (failed > 0) text += ", failed: " + std::to_string(failed);
    return text;
}

Figure makeEnergy(const FigureContext& context) {
    Figure figure = startFigure(context, "Energy error");
    const std::string unit = context.system ? context.system->energyUnit : columnInfo(context, "energy").unit;
    figure.y = logAxis(axisTitle("|H − H(0)|", unit));
    addErrors(figure, context, "energy_error");

    const double scale = initialNorm(context.comparison, "energy");  // at t = 0 energy_error adds nothing
    if (scale > 0) figure.put(RoundOffFloor{0x1p-52 * scale});
    addChance(figure, context);
    const std::string trends = trendsOf(context.comparison, scale);
    const bool known = !trends.empty();
    const std::string source = context.system ? energySource(*context.system) : std::string();
    figure.subtitle = trends;
    if (known && !source.empty()) figure.subtitle = "no invariant: " + source;
    std::vector<std::pair<double, std::string>> largest;
    if (isAgainstSteps(context.view) && scale > 0)
        for (const Series& s : figure.series())
            if (s.style >= 0) largest.emplace_back(maxMagnitude(s.y) / scale, s.label);
    if (!largest.empty()) figure.subtitle = "relative, at most: " + leastToMost(largest);
    finishFigure(
        figure, context,
        "Energy error " + againstText(context.view) + ", " + (known ? figure.subtitle : "not measured"));
    return figure;
}

}  // namespace

RecipeEntry energy() { return {"energy", makeEnergy}; }

}  // namespace extremal::recipes
