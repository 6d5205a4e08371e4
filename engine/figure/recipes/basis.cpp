// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of one step, with the nodes and weights of the rule: those that vanish at both ends,
/// orthonormal in their slopes, pale; the one that goes from 0 to 1, full. At each node a stroke as high as
/// its weight, in units of the largest. In space: the functions of an element, or the modes of the domain.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/figure/build.hpp"
#include "engine/figure/step_functions.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/space/typed.hpp"
#include "engine/view/with_equations.hpp"

namespace extremal::recipes {
namespace {

/// What a scheme shows in a direction: its functions, or why it has none.
struct ShownFunctions {
    std::optional<Table<double>> ofTime;
    std::optional<SpaceFunctions> ofSpace;
    std::string failure;
};

/// The start of a scheme at which its functions are shown: that of the scene.
State startOf(const FigureContext& context, const SchemeResult& scheme) {
    const ResolvedScheme& resolved = *scheme.scheme;
    if (resolved.ownSystem) return resolved.ownInitial;
    return initialState(context.comparison.scene, *context.system);
}

ShownFunctions functionsOf(const FigureContext& context, const SchemeResult& scheme, bool isSpace) {
    const Discretization* const plain = scheme.scheme ? scheme.scheme->plain() : nullptr;
    if (!plain) return {{}, {}, "not a discretization"};
    if (!scheme.scheme->properties.refusal.empty()) return {{}, {}, scheme.scheme->properties.refusal};
    const StepEquations& entry = equationsOf(*plain);
    const std::string lacking =
        isSpace ? entry.spaceFunctions.lackingOf(*plain) : entry.functions.lackingOf(*plain);
    if (!lacking.empty()) return {{}, {}, lacking};
    try {
        const State start = startOf(context, scheme);
        const System& system = systemOf(context, scheme);
        const Discretization d = withEstimates(*plain, system, start);
        const StepCase step{system, d, start, scheme.spec.step.value};
        if (isSpace) return {{}, entry.spaceFunctions.make(step), ""};
        return {entry.functions.make(step), {}, ""};
    } catch (const InvalidScene& error) {
        return {{}, {}, error.what()};
    }
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

/// A stroke at each node, as high as its weight.
void addRule(Figure& figure, const SchemeResult& scheme, std::span<const double> places,
             std::span<const double> weights) {
    double largest = 0;
    for (const double w : weights) largest = std::max(largest, std::abs(w));
    Series nodes;
    nodes.label = scheme.spec.label;
    nodes.part = "nodes";
    nodes.style = scheme.style;
    nodes.kind = SeriesKind::marks;
    for (std::size_t i = 0; i < places.size(); ++i) {
        nodes.x.push_back(places[i]);
        nodes.y.push_back(0);
        figure.add(Guide{{places[i], places[i]}, {0, weights[i] / largest}, true});
    }
    if (!places.empty()) figure.add(std::move(nodes));
}

void addTime(Figure& figure, const SchemeResult& scheme, const Table<double>& table) {
    const ResolvedScheme& resolved = *scheme.scheme;
    addFunctions(figure, scheme, table);
    addRule(figure, scheme, {table.node.data(), static_cast<std::size_t>(table.nodes())},
            {table.weight.data(), static_cast<std::size_t>(table.nodes())});
    std::vector<std::string> facts =
        stepFacts(table, withStep(resolved.plain()->space, scheme.spec.step.value));
    facts.insert(facts.begin() + 1, "order " + std::to_string(resolved.claims.order));
    for (const std::string& fact : facts) figure.subtitle += (figure.subtitle.empty() ? "" : " · ") + fact;
}

void addSpace(Figure& figure, const SchemeResult& scheme, const SpaceFunctions& functions) {
    for (const SpaceFunctions::Curve& curve : functions.curves) {
        Series s;
        s.label = scheme.spec.label;
        s.part = curve.name;
        s.style = scheme.style;
        s.x = curve.x;
        s.y = curve.y;
        figure.add(std::move(s));
    }
    addRule(figure, scheme, functions.nodes, functions.weights);
    figure.x.title = functions.axis;
    figure.x.range = std::nullopt;
    figure.subtitle = functions.text;
}

Figure makeBasis(const FigureContext& context) {
    const bool isSpace = isOfSpace(context.view);
    const std::string what = isSpace ? "Functions of space" : "Functions of a step";
    Figure figure = startFigure(context, what);
    figure.x.title = "τ";
    figure.x.range = {0, 1};
    figure.y.title = "φ";
    ShownFunctions shown;
    std::string reasons;
    const SchemeResult* const scheme = schemeOf(context, [&](const SchemeResult& s) {
        if (!context.system || (!context.view.scheme.empty() && s.spec.label != context.view.scheme))
            return false;
        shown = functionsOf(context, s, isSpace);
        if (shown.failure.empty()) return true;
        reasons += (reasons.empty() ? ": " : "; ") + s.spec.label + ": " + shown.failure;
        return false;
    });
    if (!scheme) {
        figure.message = context.comparison.isFinished
                             ? (isSpace ? "No functions of space" : "No functions of a step") + reasons
                             : "";
        finishFigure(figure, context, what);
        return figure;
    }
    if (shown.ofTime)
        addTime(figure, *scheme, *shown.ofTime);
    else
        addSpace(figure, *scheme, *shown.ofSpace);
    figure.title = (isSpace ? "Functions in space of " : "Functions of ") + scheme->spec.label;
    finishFigure(figure, context, "");
    figure.drop<FailureMark>();
    figure.summary = figure.title + (isSpace ? ": " : " over one step: ") + figure.subtitle + ".";
    return figure;
}

}  // namespace

RecipeEntry basis() { return {"basis", makeBasis}; }

}  // namespace extremal::recipes
