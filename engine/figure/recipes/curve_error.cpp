// SPDX-License-Identifier: GPL-3.0-or-later
/// How good the schemes are between their nodes: distance of the dense output of each scheme from
/// the reference.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

double largest(std::span<const double> values) {
    double most = 0;
    for (const double v : values)
        if (std::isfinite(v)) most = std::max(most, std::abs(v));
    return most;
}

Figure makeCurveError(const FigureContext& context) {
    Figure figure = startFigure(context, "Error between nodes");
    const ColumnInfo error = columnInfo(context, "error");
    figure.x = timeAxis(context);
    figure.y = logAxis(axisTitle(error.symbol == "error" ? "‖q − q_ref‖" : error.symbol, error.unit));
    std::string text;
    for (const auto& scheme : context.comparison.schemes) {
        const DenseOutput* dense = scheme->products.find<DenseOutput>();
        if (!dense || !dense->points.find("error")) continue;
        const std::span<const double> t = dense->points["t"], e = dense->points["error"];
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x.assign(t.begin(), t.end());
        for (const double v : e) s.y.push_back(std::abs(v));
        figure.add(std::move(s));
        text += (text.empty() ? "" : ", ") + shortNumber(largest(e)) + " (" +
                shortNumber(scheme->summary.maxError) + ")";
    }
    if (!text.empty()) figure.subtitle = "largest on the curve (at nodes): " + text;
    const bool isKnown = context.comparison.reference.type != "none";
    if (figure.series().empty() && context.comparison.isFinished)
        figure.message = isKnown ? "Curves are kept in runs of up to 4000 steps"
                                 : "Without a reference there is no error to show";
    finishFigure(figure, context,
                 "Distance of the curves from the reference against time, " + figure.subtitle);
    return figure;
}

}  // namespace

RecipeEntry curve_error() { return {"curve_error", makeCurveError}; }

}  // namespace extremal::recipes
