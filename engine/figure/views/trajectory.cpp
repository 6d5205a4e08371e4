/// The orbit, where the system moves in a plane; else a coordinate against time.
#include "engine/figure/column_figure.hpp"

namespace extremal::views {
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
    std::string x = context.view.x, y = context.view.y;
    const bool isOrbit = x.empty() && y.empty() && context.system && context.system->hasPlanarTrajectory;
    if (isOrbit) {
        x = context.system->trajectoryX;
        y = context.system->trajectoryY;
    }
    if (x.empty()) x = std::string("t");
    if (y.empty() && context.system) y = context.system->trajectoryY;
    if (y.empty()) y = firstCoordinate(context);

    if (!isOrbit) return columnFigure(context, x, y);
    Figure figure = startFigure(context, "Trajectory");
    figure.hasEqualScales = true;
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x.title = axisTitle(xInfo.symbol, xInfo.unit);
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    addCurves(figure, context, x, y);
    finishFigure(figure, context, "Orbit in the plane of " + xInfo.symbol + " and " + yInfo.symbol);
    return figure;
}

/// Columns plotted against time each, where no plane holds the trajectory and there are not too many.
std::vector<std::string> timePlots(const System& system) {
    if (!system.timePlots.empty()) return system.timePlots;
    std::vector<std::string> columns;
    if (system.hasPlanarTrajectory || system.dimension() < 2 || system.dimension() > 3) return columns;
    for (const Coordinate& c : system.coordinates) columns.push_back("q." + c.name);
    return columns;
}

}  // namespace

ViewEntry trajectory() {
    return {{"trajectory", "Trajectory", "the orbit in its plane, or a coordinate against time", {}, {}, {}}, "", makeTrajectory,
            timePlots};
}

}  // namespace extremal::views
