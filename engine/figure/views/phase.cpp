/// Phase portrait: one state column against another, by default the first momentum over the first coordinate.
#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

std::string firstColumn(const FigureContext& context, const char* prefix) {
    for (const auto& scheme : context.comparison.schemes)
        for (const Column& c : scheme->trajectory.columns)
            if (c.name.starts_with(prefix)) return c.name;
    return std::string(prefix) + "?";
}

Figure makePhase(const FigureContext& context) {
    std::string x = context.view.x, y = context.view.y;
    if (x.empty()) x = context.system ? context.system->phaseX : firstColumn(context, "q.");
    if (y.empty()) y = context.system ? context.system->phaseY : firstColumn(context, "p.");
    Figure figure = startFigure(context, "Phase portrait");
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x = x == "t" ? timeAxis(context) : Axis{axisTitle(xInfo.symbol, xInfo.unit), false, false, {}};
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    addCurves(figure, context, x, y);
    finishFigure(figure, context, "Phase portrait of " + yInfo.symbol + " over " + xInfo.symbol);
    return figure;
}

}  // namespace

ViewEntry phase() {
    ViewEntry e{{"phase",
                 "Phase portrait",
                 "momentum over coordinate, or any two state columns",
                 {textField("x", "x", "", "state column to the right, by default the model's choice"),
                  textField("y", "y", "", "state column upwards, by default the model's choice")},
                 {},
                 {}},
                "",
                makePhase};
    e.scales.across = Across::column;
    e.xColumn = [](const View& view, const System& system) {
        return view.x.empty() ? system.phaseX : view.x;
    };
    return e;
}

}  // namespace extremal::views
