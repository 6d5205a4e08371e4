#include "engine/figure/momentum_components.hpp"

#include "engine/figure/column_figure.hpp"

namespace extremal {

std::vector<std::string> momentumColumns(const System& system, const std::string& frame) {
    std::vector<std::string> names;
    for (const Quantity& c : stateColumns(system))
        if (c.name.starts_with("momentum." + frame + ".")) names.push_back(c.name);
    return names;
}

Figure momentumComponent(const FigureContext& context, const std::string& frame) {
    const std::vector<std::string> columns =
        context.system ? momentumColumns(*context.system, frame) : std::vector<std::string>{};
    if (!columns.empty())
        return columnFigure(context, "t", context.view.y.empty() ? columns.front() : context.view.y);
    const std::string title = frame == "body" ? "Body momentum" : "Space momentum";
    Figure figure = startFigure(context, title);
    figure.x = timeAxis(context);
    figure.message = "Only rigid bodies have a momentum in body and in space";
    finishFigure(figure, context, title);
    return figure;
}

}  // namespace extremal
