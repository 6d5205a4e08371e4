// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of each coefficient of a wave function at the end, on a logarithmic axis: are there enough? Over
/// a rectangle the largest along x, and along y (model/parts/coefficient_sizes.hpp).
#include <utility>

#include "engine/figure/build.hpp"
#include "engine/model/parts/coefficient_sizes.hpp"

namespace extremal::recipes {
namespace {

Figure makeSpectrum(const FigureContext& context) {
    Figure figure = startFigure(context, "Spectrum");
    figure.x.title = "wave number";
    figure.y = logAxis("|c|");
    const auto* const sizes = context.system ? context.system->parts.find<CoefficientSizes>() : nullptr;
    for (const auto& scheme : context.comparison.schemes) {
        if (!sizes || !framesOf(*scheme)) continue;
        Tone tone = Tone::full;
        for (CoefficientSizes::Line& line : sizes->lines(*framesOf(*scheme)->back().values)) {
            Series s;
            s.label = scheme->spec.label;
            s.style = scheme->style;
            s.part = line.part;
            s.tone = std::exchange(tone, Tone::pale);
            s.x = std::move(line.x);
            s.y = std::move(line.sizes);
            figure.add(std::move(s));
        }
        figure.subtitle = sizes->remark;
    }
    figure.put(RoundOffFloor{0x1p-52});
    if (sizes) {
        figure.x.title = sizes->title;
        figure.x.range = {sizes->low, sizes->high};
    } else if (context.system) {
        figure.message = "The model is not a wave function";
    }
    finishFigure(figure, context, "Size of the coefficients at the end");
    return figure;
}

}  // namespace

RecipeEntry spectrum() { return {"spectrum", makeSpectrum}; }

}  // namespace extremal::recipes
