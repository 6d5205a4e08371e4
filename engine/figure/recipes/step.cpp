/// The step size against time. A scheme with a fixed step needs no column for it.
#include <cmath>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

Figure makeStep(const FigureContext& context) {
    Figure figure = startFigure(context, "Step size");
    figure.x = timeAxis(context);
    figure.y = logAxis(axisTitle("h", columnInfo(context, "t").unit));
    addAgainstTime(figure, context, "step", Take::magnitude);
    for (const auto& scheme : context.comparison.schemes) {
        const std::span<const double> t = scheme->trajectory["t"];
        if (t.empty() || scheme->trajectory.find("step") || !(scheme->spec.step.value > 0)) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = {t.front(), t.back()};
        s.y = {scheme->spec.step.value, scheme->spec.step.value};
        figure.add(std::move(s));
    }
    finishFigure(figure, context, "Step size against time");
    return figure;
}

}  // namespace

RecipeEntry step() { return {"step", makeStep}; }

}  // namespace extremal::recipes
