// SPDX-License-Identifier: GPL-3.0-or-later
/// The cube root of the density of the local action error against time, with a line at zero where it would
/// change its sign. Along an eccentric orbit the density varies by four powers of ten; the root keeps its
/// sign, and its zeros can be seen.
#include <cmath>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

Figure makeSolvability(const FigureContext& context) {
    Figure figure = startFigure(context, "Solvability density");
    figure.x = timeAxis(context);
    figure.y.title = "∛ℓ";
    addAgainstTime(figure, context, "density", Take::value);
    for (Series& s : figure.series())
        for (double& v : s.y) v = std::cbrt(v);
    int definite = 0, known = 0;
    for (const Series& s : figure.series()) {
        bool hasPositive = false, hasNegative = false;
        for (const double v : s.y) {
            hasPositive = hasPositive || v > 0;
            hasNegative = hasNegative || v < 0;
        }
        known += hasPositive || hasNegative;
        definite += hasPositive != hasNegative;
    }
    if (known > 0)
        figure.subtitle = "of one sign: " + std::to_string(definite) + " of " + std::to_string(known);
    if (known > 0 && figure.x.range)
        figure.add(Guide{{figure.x.range->first, figure.x.range->second}, {0, 0}, true});
    finishFigure(figure, context,
                 "Cube root of the density of the local action error against time, " + figure.subtitle);
    return figure;
}

}  // namespace

RecipeEntry solvability() { return {"solvability", makeSolvability}; }

}  // namespace extremal::recipes
