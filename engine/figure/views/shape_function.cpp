/// The shape function of a node: what the finite elements of each scheme are made of.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/model/elliptic.hpp"
#include "engine/scene/bind.hpp"

namespace extremal::views {
namespace {

Figure makeShapeFunction(const FigureContext& context) {
    Figure figure = startFigure(context, "Shape function");
    figure.x.title = "x";
    figure.y.title = "φ";
    double left = 1, right = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const auto pair = pairOf(scheme->spec);
        if (!context.system || !kindOf<BoundaryProblem>(*context.system) || !pair ||
            pair->space.type != "elliptic-elements")
            continue;
        const int elements = static_cast<int>(std::lround(1 / scheme->spec.step.value));
        const int node = context.view.node ? static_cast<int>(context.view.node->value) : elements / 2;
        if (node < 1 || node >= elements) continue;
        const bool isLinear = pair->space.text("functions") == "linear";
        EllipticHat hat =
            ellipticHat(*std::get<BoundaryProblem>(context.system->kind).problem,
                        isLinear ? EllipticElements::linear : EllipticElements::multiscale, elements, node);
        left = std::min(left, hat.x.front());
        right = std::max(right, hat.x.back());
        if (figure.subtitle.empty())
            figure.subtitle = "of node " + std::to_string(node) + " of " + std::to_string(elements) +
                              ", x = " + shortNumber(static_cast<double>(node) / elements, 4);
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = std::move(hat.x);
        s.y = std::move(hat.phi);
        figure.series.push_back(std::move(s));
    }
    if (right > left) figure.x.range = {left, right};
    if (context.system && !kindOf<BoundaryProblem>(*context.system))
        figure.message = "Only schemes of the elliptic problem have shape functions";
    finishFigure(figure, context, "Shape function " + figure.subtitle);
    figure.failures.clear();
    return figure;
}

}  // namespace

ViewEntry shape_function() {
    return {{"shape-function",
             "Shape function",
             "the function of a node that each scheme of the elliptic problem is made of",
             {integerField("node", "i", 1, 1e5, nullptr,
                           "node inside, from left to right; by default the one in the middle")},
             {},
             {}},
            "",
            makeShapeFunction,
            nullptr,
            againstPlace};
}

}  // namespace extremal::views
