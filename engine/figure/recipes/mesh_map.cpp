// SPDX-License-Identifier: GPL-3.0-or-later
/// The map from the computational domain to space at the end of each scheme: X over xi, the share of the
/// nodes to its left; its derivative as a density of nodes over X; and the field over xi.
#include <string>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

/// A curve of the frame, in its own units: nodes at places X, values u.
Series meshCurve(const std::string& show, std::span<const double> X, const std::vector<double>& u) {
    Series s;
    const auto elements = static_cast<double>(X.size() - 1);
    for (std::size_t i = 0; i < X.size(); ++i) {
        if (show == "density") {
            if (i + 1 == X.size()) break;
            s.x.push_back((X[i] + X[i + 1]) / 2);
            s.y.push_back(1 / (X[i + 1] - X[i]));
        } else {
            s.x.push_back(static_cast<double>(i) / elements);
            s.y.push_back(show == "field" ? u[i] : X[i]);
        }
    }
    return s;
}

Figure makeMeshMap(const FigureContext& context) {
    const std::string show = context.view.keys.text("show");
    Figure figure = startFigure(context, show == "density" ? "Density of nodes"
                                         : show == "field" ? "Field over the computational domain"
                                                           : "Mesh map");
    figure.x.title = show == "density" ? "x" : "ξ";
    if (show == "density")
        figure.y = logAxis("1/h");
    else
        figure.y.title = show == "field" ? "u" : "X(ξ)";
    for (const auto& scheme : context.comparison.schemes) {
        if (!context.system || !framesOf(*scheme)) continue;
        const FieldSampling& field = systemOf(context, *scheme).field;
        const std::vector<Frame>& frames = *framesOf(*scheme);
        for (const bool isStart : {true, false}) {
            if (isStart && !field.hasMovingNodes) continue;
            const std::vector<double>& values = *(isStart ? frames.front() : frames.back()).values;
            Series s = meshCurve(show, field.nodesOf(values), values);
            s.label = scheme->spec.label;
            s.style = scheme->style;
            s.tone = isStart ? Tone::pale : Tone::full;
            s.part = isStart ? "at the start" : "";
            figure.add(std::move(s));
        }
        figure.subtitle = "at t = " + shortNumber(frames.back().t, 4) + "; pale: at the start";
    }
    finishFigure(figure, context, "Meshes of the schemes");
    return figure;
}

}  // namespace

RecipeEntry mesh_map() { return {"mesh_map", makeMeshMap}; }

}  // namespace extremal::recipes
