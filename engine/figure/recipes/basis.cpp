/// The functions of one step, with the nodes and weights of the rule: those that vanish at both ends,
/// orthonormal in their slopes, pale; the one that goes from 0 to 1, full. At each node a stroke as high as
/// its weight, in units of the largest.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/family/table_of.hpp"
#include "engine/figure/build.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/space/typed.hpp"

namespace extremal::recipes {
namespace {

constexpr int points = 240;

bool hasFunctions(const SchemeResult& scheme) {
    const ResolvedScheme* const resolved = scheme.scheme.get();
    const Discretization* const plain = resolved ? resolved->plain() : nullptr;
    return plain && resolved->properties.refusal.empty() &&
           (hasTable(*plain) || (!isTermRule(plain->quadrature) && dependsOnStep(plain->space)));
}

void addFunctions(Figure& figure, const SchemeResult& scheme, const Table<double>& table) {
    const auto n = static_cast<std::size_t>(table.space.size);
    std::vector<double> value(n), slope(n);
    std::vector<Series> all(static_cast<std::size_t>(table.unknowns()));
    for (int i = 0; i <= points; ++i) {
        const double tau = static_cast<double>(i) / points;
        table.space.evaluate(tau, value, slope);
        const Eigen::VectorXd phi =
            table.change.transpose() * Eigen::Map<const Eigen::VectorXd>(value.data(), table.space.size);
        for (std::size_t a = 0; a < all.size(); ++a) {
            all[a].x.push_back(tau);
            all[a].y.push_back(phi(static_cast<Eigen::Index>(a)));
        }
    }
    for (std::size_t a = 0; a < all.size(); ++a) {
        const bool isLast = a + 1 == all.size();
        all[a].label = scheme.spec.label;
        all[a].style = scheme.style;
        all[a].part = isLast ? "from 0 to 1" : "inside " + std::to_string(a + 1);
        all[a].tone = isLast ? Tone::full : Tone::pale;
        figure.add(std::move(all[a]));
    }
}

void addRule(Figure& figure, const SchemeResult& scheme, const Table<double>& table) {
    const double largest = table.weight.cwiseAbs().maxCoeff();
    Series nodes;
    nodes.label = scheme.spec.label;
    nodes.part = "nodes";
    nodes.style = scheme.style;
    nodes.kind = SeriesKind::marks;
    for (int i = 0; i < table.nodes(); ++i) {
        nodes.x.push_back(table.node(i));
        nodes.y.push_back(0);
        figure.add(Guide{{table.node(i), table.node(i)}, {0, table.weight(i) / largest}, true});
    }
    figure.add(std::move(nodes));
}

Figure makeBasis(const FigureContext& context) {
    Figure figure = startFigure(context, "Functions of a step");
    figure.x.title = "τ";
    figure.x.range = {0, 1};
    figure.y.title = "φ";
    const SchemeResult* const scheme = schemeOf(context, hasFunctions);
    if (!scheme) {
        figure.message = context.comparison.isFinished ? "No discretization with functions of a step" : "";
        finishFigure(figure, context, "Functions of a step");
        return figure;
    }
    const ResolvedScheme& resolved = *scheme->scheme;
    const Discretization& d = *resolved.plain();
    const Table<double> table = tableOf(withStep(d.space, scheme->spec.step.value), d.quadrature);
    addFunctions(figure, *scheme, table);
    addRule(figure, *scheme, table);
    figure.title = "Functions of " + scheme->spec.label;
    const Eigen::VectorXd K = kineticValues(table);
    figure.subtitle = std::to_string(table.space.size) + " functions, " + std::to_string(table.nodes()) +
                      (table.nodes() == 1 ? " node" : " nodes") + " · order " +
                      std::to_string(resolved.claims.order) + " · K from " + shortNumber(K.minCoeff(), 3) +
                      " to " + shortNumber(K.maxCoeff(), 3);
    if (d.space.find("functions"))
        figure.subtitle +=
            " · σ " + shortNumber(typedSpace(withStep(d.space, scheme->spec.step.value)).sigma, 2);
    finishFigure(figure, context, "");
    figure.drop<FailureMark>();
    figure.summary = figure.title + " over one step: " + figure.subtitle + ".";
    return figure;
}

}  // namespace

RecipeEntry basis() { return {"basis", makeBasis}; }

}  // namespace extremal::recipes
