// SPDX-License-Identifier: GPL-3.0-or-later
/// A Poincaré section: the states where one column passes zero upwards, found on the dense output of each
/// scheme.
#include "engine/figure/build.hpp"

#include "engine/figure/starts.hpp"
#include "engine/view/plane.hpp"

namespace extremal::recipes {
namespace {

Figure makeSection(const FigureContext& context) {
    const auto plane = context.system ? planeOf(context.view, *context.system) : std::nullopt;
    const auto [x, y, at] = plane.value_or(ViewPlane{context.view.x, context.view.y, context.view.at});
    Figure figure = startFigure(context, "Section");
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x = x == "t" ? timeAxis(context) : Axis{axisTitle(xInfo.symbol, xInfo.unit), false, false, {}};
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    figure.subtitle = columnInfo(context, at).symbol + " = 0, upwards";
    std::size_t most = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const Sections* sections = scheme->products.find<Sections>();
        if (!sections || (!context.view.scheme.empty() && scheme->spec.label != context.view.scheme))
            continue;
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
    addStarts(figure, context);
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
