// SPDX-License-Identifier: GPL-3.0-or-later
/// How large an error is over a grid of a parameter of the model and the step, as colours: one scheme a
/// picture, one scale for all of them. Cases that failed or blew up have none.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

/// Powers of ten that hold the values of all schemes but for the two percent at either end: what is about to
/// blow up must not take the scale from the others.
std::pair<double, double> decadesOf(const std::vector<const ParameterMap*>& maps) {
    std::vector<double> all;
    for (const ParameterMap* map : maps)
        for (const MapCell& cell : map->cells)
            if (cell.isDone() && cell.value > 0) all.push_back(std::log10(cell.value));
    if (all.empty()) return {-1, 0};
    const auto at = [&](double part) {
        const auto place =
            all.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(all.size() - 1));
        std::nth_element(all.begin(), place, all.end());
        return *place;
    };
    const double low = std::floor(at(0.02) + 1e-9), high = std::ceil(at(0.98) - 1e-9);
    return {low, std::max(high, low + 1)};
}

/// The edges of cells around values in equal ratios.
std::pair<double, double> edgesOf(const std::vector<double>& values) {
    const double half =
        std::pow(values.back() / values.front(), 0.5 / static_cast<double>(values.size() - 1));
    return {values.front() / half, values.back() * half};
}

HeatMap heatOfMap(const ParameterMap& map, std::pair<double, double> decades, std::string scale) {
    HeatMap heat;
    heat.columns = static_cast<int>(map.grid.values.size());
    heat.rows = static_cast<int>(map.grid.steps.size());
    std::tie(heat.left, heat.right) = edgesOf(map.grid.values);
    std::tie(heat.bottom, heat.top) = edgesOf(map.grid.steps);
    heat.low = std::pow(10, decades.first);
    heat.high = std::pow(10, decades.second);
    heat.xs = map.grid.values;
    heat.ys = map.grid.steps;
    heat.scale = std::move(scale);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        const MapCell& cell = map.cells[i];
        heat.values.push_back(cell.isDone() ? cell.value : Summary::unknown);
        const bool isFault = !cell.isDone() && cell.end != MapCell::End::waiting;
        heat.faults.emplace_back(isFault ? name(cell) : std::string_view());
        const std::string& problem = map.problems[i / map.grid.steps.size()];
        if (cell.end == MapCell::End::refused && !problem.empty()) heat.faults.back() += ": " + problem;
    }
    return heat;
}

/// "|H - H(0)|"; a norm is its own size.
std::string sizeText(const std::string& symbol) {
    const bool isSize = symbol.starts_with('|') || symbol.starts_with("‖");
    return isSize ? symbol : "|" + symbol + "|";
}

/// Where the scene itself stands.
Series sceneIn(const ParameterMap& map, const FigureContext& context) {
    Series here;
    here.label = map.scheme;
    here.style = map.style;
    here.kind = SeriesKind::marks;
    for (const ModelParameter& p : parametersOf(context.comparison.scene))
        if (p.name == map.grid.parameter) here.x = {p.value};
    for (const auto& scheme : context.comparison.schemes)
        if (scheme->spec.label == map.scheme) here.y = {scheme->spec.step.value};
    return here;
}

Figure makeParameterMap(const FigureContext& context) {
    Figure figure = startFigure(context, "Parameter map");
    std::vector<const ParameterMap*> alike;
    const ParameterMap* shown = nullptr;
    const auto& scene = context.comparison.scene;
    const ParameterMaps* maps = context.comparison.products.find<ParameterMaps>();
    for (const auto& map : maps ? maps->all : ParameterMaps{}.all) {
        if (map->view >= scene.views.size() || !(scene.views[map->view].keys == context.view.keys)) continue;
        alike.push_back(map.get());
        if (!shown && (context.view.scheme.empty() || context.view.scheme == map->scheme)) shown = map.get();
    }
    figure.x.isLog = figure.y.isLog = true;
    if (!shown || !context.system) {
        if (!maps || maps->all.empty()) figure.message = "No scheme that runs has a step";
        finishFigure(figure, context, "Errors over a parameter and the step");
        figure.drop<FailureMark>();
        return figure;
    }
    const MapGrid& grid = shown->grid;
    for (const ModelParameter& p : parametersOf(scene))
        if (p.name == grid.parameter) figure.x = logAxis(axisTitle(p.symbol, p.unit));
    figure.y = logAxis(axisTitle("h", context.system->timeUnit));
    std::string scale = grid.column;
    for (const ObservedColumn& c : observableColumns(scene, *context.system))
        if (c.name == grid.column)
            scale = axisTitle("max " + sizeText(c.symbol.empty() ? c.name : c.symbol), c.unit);
    figure.title = shown->scheme;
    figure.add(heatOfMap(*shown, decadesOf(alike), scale));
    figure.x.range = {figure.heat()->left, figure.heat()->right};
    figure.y.range = {figure.heat()->bottom, figure.heat()->top};
    const auto known =
        std::count_if(shown->cells.begin(), shown->cells.end(), [](const MapCell& c) { return c.isDone(); });
    const auto waiting = std::count_if(shown->cells.begin(), shown->cells.end(),
                                       [](const MapCell& c) { return c.end == MapCell::End::waiting; });
    const auto all = static_cast<std::ptrdiff_t>(shown->cells.size());
    const std::string unit = context.system->timeUnit.empty() ? "" : " " + context.system->timeUnit;
    const std::string measured = scale.substr(0, scale.find("  ["));
    figure.subtitle = measured + " to " + context.system->independent + " = " +
                      shortNumber(scene.start.value + grid.duration, 4) + unit;
    if (known + waiting < all)
        figure.subtitle +=
            " · " + std::to_string(all - known - waiting) + " of " + std::to_string(all) + " fail";
    figure.add(sceneIn(*shown, context));
    finishFigure(figure, context,
                 shown->scheme + ": " + figure.subtitle + ", over " + grid.parameter + " and the step");
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry parameter_map() { return {"parameter_map", makeParameterMap}; }

}  // namespace extremal::recipes
