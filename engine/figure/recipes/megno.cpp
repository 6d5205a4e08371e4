// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean of MEGNO against the logarithm of time, with a line at 2, to which it tends on regular motions.
#include "engine/figure/growth.hpp"

namespace extremal::recipes {
namespace {

Figure makeMegno(const FigureContext& context) {
    Figure figure = growthFigure(context, "megno", Take::value);
    figure.y.title = "Ȳ";
    const std::string values = lastValues(figure);
    if (!values.empty()) figure.subtitle = "at the end " + values;
    if (!values.empty() && figure.x.range)
        figure.add(Guide{{figure.x.range->first, figure.x.range->second}, {2, 2}, true});
    finishFigure(figure, context, "Mean of MEGNO up to each time, 2 on regular motions, " + figure.subtitle);
    return figure;
}

}  // namespace

RecipeEntry megno() { return {"megno", makeMegno}; }

}  // namespace extremal::recipes
