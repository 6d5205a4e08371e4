// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of one step, with the nodes and weights of the rule: those that vanish at both ends,
/// orthonormal in their slopes, pale; the one that goes from 0 to 1, full. At each node a stroke as high as
/// its weight, in units of the largest.
#include <string>
#include <vector>

#include "engine/family/table_of.hpp"
#include "engine/figure/build.hpp"
#include "engine/figure/step_functions.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/space/typed.hpp"

namespace extremal::recipes {
namespace {

bool hasFunctions(const SchemeResult& scheme) {
    const ResolvedScheme* const resolved = scheme.scheme.get();
    const Discretization* const plain = resolved ? resolved->plain() : nullptr;
    return plain && resolved->properties.refusal.empty() &&
           (hasTable(*plain) || (!isTermRule(plain->quadrature) && dependsOnStep(plain->space)));
}

void addFunctions(Figure& figure, const SchemeResult& scheme, const Table<double>& table) {
    std::vector<Series> all = stepFunctions(table);
    for (Series& curve : all) {
        curve.label = scheme.spec.label;
        curve.style = scheme.style;
        curve.tone = &curve == &all.back() ? Tone::full : Tone::pale;
        figure.add(std::move(curve));
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
    const Settings space = withStep(d.space, scheme->spec.step.value);
    const Table<double> table = tableOf(space, d.quadrature);
    addFunctions(figure, *scheme, table);
    addRule(figure, *scheme, table);
    figure.title = "Functions of " + scheme->spec.label;
    std::vector<std::string> facts = stepFacts(table, space);
    facts.insert(facts.begin() + 1, "order " + std::to_string(resolved.claims.order));
    for (const std::string& fact : facts) figure.subtitle += (figure.subtitle.empty() ? "" : " · ") + fact;
    finishFigure(figure, context, "");
    figure.drop<FailureMark>();
    figure.summary = figure.title + " over one step: " + figure.subtitle + ".";
    return figure;
}

}  // namespace

RecipeEntry basis() { return {"basis", makeBasis}; }

}  // namespace extremal::recipes
