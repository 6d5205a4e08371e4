// SPDX-License-Identifier: GPL-3.0-or-later
/// The meshes of time, one above the other: a tick at every node of a scheme. Of very fine ones every m-th
/// node, which leaves the ratios of distances as they are.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/figure/build.hpp"
#include "engine/run/march/step_records.hpp"

namespace extremal::recipes {
namespace {

constexpr std::size_t mostTicks = 150;

/// The times of all nodes where they are known, else those of the rows; a fixed step gives all.
std::vector<double> nodeTimes(const SchemeResult& scheme) {
    std::vector<double> times;
    if (const StepRecords* steps = scheme.products.find<StepRecords>(); steps && !steps->all.empty()) {
        for (const StepRecord& s : steps->all) times.push_back(s.t);
        if (std::isfinite(steps->all.back().step)) times.push_back(times.back() + steps->all.back().step);
        return times;
    }
    const std::span<const double> t = scheme.trajectory["t"];
    const bool isFixed = scheme.scheme && scheme.scheme->isFixed() && scheme.spec.step.value > 0;
    if (!isFixed || t.empty()) return {t.begin(), t.end()};
    const Clock clock{t.front(), scheme.spec.step.value};
    for (long long k = 0; k <= scheme.summary.steps; ++k) times.push_back(clock.at(k));
    return times;
}

Figure makeMesh(const FigureContext& context) {
    Figure figure = startFigure(context, "Time mesh");
    figure.x = timeAxis(context);
    const auto& schemes = context.comparison.schemes;
    std::string finest;
    double lane = static_cast<double>(schemes.size());
    for (const auto& scheme : schemes) {
        lane -= 1;
        const std::vector<double> times = nodeTimes(*scheme);
        figure.y.ticks.push_back({lane, scheme->spec.label});
        if (times.empty()) continue;
        const std::size_t stride = times.size() / mostTicks + 1;
        if (stride > 1)
            finest += (finest.empty() ? "" : ", ") + std::to_string(stride) + " (" + scheme->spec.label + ")";
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.kind = SeriesKind::ticks;
        for (std::size_t i = 0; i < times.size(); i += stride) s.x.push_back(times[i]);
        s.y.assign(s.x.size(), lane);
        figure.add(std::move(s));
    }
    figure.y.range = {-0.6, static_cast<double>(schemes.size()) - 0.4};
    if (!finest.empty()) figure.subtitle = "nodes per tick: " + finest;
    finishFigure(figure, context, "Nodes of time of " + std::to_string(schemes.size()) + " schemes");
    return figure;
}

}  // namespace

RecipeEntry mesh() { return {"mesh", makeMesh}; }

}  // namespace extremal::recipes
