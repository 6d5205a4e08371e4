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

bool isOrbitIn(const View& view, const System& system) {
    return view.x.empty() && view.y.empty() && system.hasPlanarTrajectory;
}

std::string xOf(const View& view, const System& system) {
    if (isOrbitIn(view, system)) return system.trajectoryX;
    return view.x.empty() ? std::string("t") : view.x;
}

Figure makeTrajectory(const FigureContext& context) {
    const bool isOrbit = context.system && isOrbitIn(context.view, *context.system);
    const std::string x = context.system           ? xOf(context.view, *context.system)
                          : context.view.x.empty() ? std::string("t")
                                                   : context.view.x;
    std::string y = isOrbit ? context.system->trajectoryY : context.view.y;
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
    ViewEntry e{{"trajectory",
                 "Trajectory",
                 "the orbit in its plane, or a coordinate against time",
                 {textField("x", "x", "", "column to the right, by default the time"),
                  textField("y", "y", "", "column upwards, by default the first coordinate")},
                 {},
                 {}},
                "",
                makeTrajectory,
                timePlots};
    e.scales.across = Across::column;
    e.xColumn = xOf;
    return e;
}

}  // namespace extremal::views
