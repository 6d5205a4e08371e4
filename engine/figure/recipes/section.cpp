/// A Poincaré section: the states where one column passes zero upwards, found on the dense output of each
/// scheme.
#include "engine/figure/build.hpp"

#include "engine/run/inside_step.hpp"

namespace extremal::recipes {
namespace {

/// By default the plane of the second coordinate; of a system with one, the momentum against time.
void fillIn(const FigureContext& context, std::string& x, std::string& y) {
    if (!context.system) return;
    const auto& coordinates = context.system->coordinates;
    if (coordinates.size() > 1) {
        if (x.empty()) x = "q." + coordinates[1].name;
        if (y.empty()) y = "p." + coordinates[1].name;
    }
    if (x.empty()) x = "t";
    if (y.empty())
        y = coordinates.empty() ? stateColumns(*context.system).back().name : "p." + coordinates.front().name;
}

Figure makeSection(const FigureContext& context) {
    std::string x = context.view.x, y = context.view.y;
    fillIn(context, x, y);
    const std::string at = context.system ? sectionColumn(context.view, *context.system) : context.view.at;
    Figure figure = startFigure(context, "Section");
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x = x == "t" ? timeAxis(context) : Axis{axisTitle(xInfo.symbol, xInfo.unit), false, false, {}};
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    figure.subtitle = columnInfo(context, at).symbol + " = 0, upwards";
    std::size_t most = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const Sections* sections = scheme->products.find<Sections>();
        if (!sections) continue;
        for (const auto& section : sections->all) {
            if (section.column != at || section.events.rows() == 0) continue;
            const std::span<const double> xs = section.events[x], ys = section.events[y];
            Series s;
            s.label = scheme->spec.label;
            s.style = scheme->style;
            s.kind = SeriesKind::marks;
            s.x.assign(xs.begin(), xs.end());
            s.y.assign(ys.begin(), ys.end());
            most = std::max(most, s.x.size());
            figure.add(std::move(s));
            break;
        }
    }
    if (figure.series().empty() && context.comparison.isFinished)
        figure.message = columnInfo(context, at).symbol + " never passes zero upwards in this run";
    finishFigure(figure, context,
                 "Section at " + figure.subtitle + ", " + std::to_string(most) + " points at most");
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry section() { return {"section", makeSection}; }

}  // namespace extremal::recipes
