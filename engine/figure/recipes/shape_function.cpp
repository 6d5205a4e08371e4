// SPDX-License-Identifier: GPL-3.0-or-later
/// The shape function of a node: what the finite elements of each scheme are made of.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/shape_functions.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal::recipes {
namespace {

Figure makeShapeFunction(const FigureContext& context) {
    Figure figure = startFigure(context, "Shape function");
    figure.x.title = "x";
    figure.y.title = "φ";
    double left = 1, right = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const ResolvedScheme* const resolved = scheme->scheme.get();
        if (!context.system || !resolved || !resolved->family || !resolved->fits(*context.system)) continue;
        const auto* const functions = resolved->family->parts.find<ShapeFunctions>();
        if (!functions) continue;
        const int wanted = context.view.node ? static_cast<int>(context.view.node->value) : 0;
        const double step = scheme->spec.step.value;
        if (wanted < 0 || wanted >= std::lround(1 / step)) continue;
        ShapeFunction function = functions->ofNode(*context.system, resolved->discretization, step, wanted);
        left = std::min(left, function.x.front());
        right = std::max(right, function.x.back());
        if (figure.subtitle.empty())
            figure.subtitle =
                "of node " + std::to_string(function.node) + " of " + std::to_string(function.elements) +
                ", x = " + shortNumber(static_cast<double>(function.node) / function.elements, 4);
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = std::move(function.x);
        s.y = std::move(function.phi);
        figure.add(std::move(s));
    }
    if (right > left) figure.x.range = {left, right};
    if (context.system && !isTaken(*context.entry.takes, context.system->parts))
        figure.message = "Only schemes of the elliptic problem have shape functions";
    finishFigure(figure, context, "Shape function " + figure.subtitle);
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry shape_function() { return {"shape_function", makeShapeFunction}; }

}  // namespace extremal::recipes
