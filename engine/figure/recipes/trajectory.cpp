// SPDX-License-Identifier: GPL-3.0-or-later
/// The orbit, where the system moves in a plane; else a coordinate against time.
#include "engine/figure/column_figure.hpp"

namespace extremal::recipes {
namespace {

std::string firstCoordinate(const FigureContext& context) {
    if (context.system)
        if (const auto columns = stateColumns(*context.system); !columns.empty()) return columns.front().name;
    for (const auto& scheme : context.comparison.schemes)
        for (const Column& c : scheme->trajectory.columns)
            if (c.name.starts_with("q.")) return c.name;
    return "q";
}

Figure makeTrajectory(const FigureContext& context) {
    const View& view = context.view;
    const bool isOrbit =
        context.system && context.system->hasPlanarTrajectory && view.x.empty() && view.y.empty();
    const std::string x = context.system   ? context.entry.xColumn(view, *context.system)
                          : view.x.empty() ? std::string("t")
                                           : view.x;
    std::string y = isOrbit ? context.system->trajectoryY : view.y;
    if (y.empty() && context.system) y = context.system->trajectoryY;
    if (y.empty()) y = firstCoordinate(context);

    if (!isOrbit) return columnFigure(context, x, y);
    Figure figure = startFigure(context, "Trajectory");
    figure.aspect = Aspect::equal;
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x.title = axisTitle(xInfo.symbol, xInfo.unit);
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    addCurves(figure, context, x, y);
    finishFigure(figure, context, "Orbit in the plane of " + xInfo.symbol + " and " + yInfo.symbol);
    return figure;
}

}  // namespace

RecipeEntry trajectory() { return {"trajectory", makeTrajectory}; }

}  // namespace extremal::recipes
