// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast waves run in each scheme, against the field equation.
#include <cmath>

#include "engine/family/family.hpp"
#include "engine/family/parts/dispersion.hpp"
#include "engine/figure/build.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal::recipes {
namespace {

Figure makeDispersion(const FigureContext& context) {
    const bool showsError = context.view.keys.text("show") == "error";
    Figure figure = startFigure(context, "Dispersion");
    figure.x.title = "wave number";
    figure.y.title = showsError ? "frequency / exact - 1" : "frequency";
    Series exact;
    for (const auto& scheme : context.comparison.schemes) {
        const ResolvedScheme* const resolved = scheme->scheme.get();
        if (!context.system || !resolved || !resolved->plain()) continue;
        const auto* const dispersion = resolved->family->parts.find<Dispersion>();
        if (!dispersion) continue;
        const DispersionCurve curve =
            dispersion->of(systemOf(context, *scheme), resolved->discretization, scheme->spec.step.value);
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = curve.waveNumber;
        s.y = curve.frequency;
        if (showsError)
            for (std::size_t i = 0; i < s.y.size(); ++i) s.y[i] = s.y[i] / curve.exact[i] - 1;
        if (exact.x.empty() || curve.waveNumber.back() > exact.x.back()) {
            exact.x = curve.waveNumber;
            exact.y = curve.exact;
        }
        figure.add(std::move(s));
    }
    if (!showsError && !exact.x.empty()) {
        exact.label = "field equation";
        exact.style = 7;
        exact.tone = Tone::pale;
        figure.add(std::move(exact));
    }
    finishFigure(figure, context, "Dispersion");
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry dispersion() { return {"dispersion", makeDispersion}; }

}  // namespace extremal::recipes
