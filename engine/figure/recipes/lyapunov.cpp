// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lyapunov exponent up to each time, both axes logarithmic: it falls like ln t / t on regular motions
/// and comes to rest on chaotic ones.
#include "engine/figure/growth.hpp"

namespace extremal::recipes {
namespace {

Figure makeLyapunov(const FigureContext& context) {
    Figure figure = growthFigure(context, "lyapunov", Take::magnitude);
    figure.y = logAxis("|λ|");
    const std::string values = lastValues(figure);
    if (!values.empty()) figure.subtitle = "at the end " + values;
    finishFigure(figure, context, "Lyapunov exponent up to each time, " + figure.subtitle);
    return figure;
}

}  // namespace

RecipeEntry lyapunov() { return {"lyapunov", makeLyapunov}; }

}  // namespace extremal::recipes
