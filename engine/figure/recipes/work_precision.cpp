// SPDX-License-Identifier: GPL-3.0-or-later
/// Measured cost against measured error, one point per scheme: lower and further left is better.
#include <cmath>
#include <functional>
#include <string_view>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

/// The error that the schemes can be judged by: the distance to the reference; else, where forces work, how
/// far energy and work are from their balance; else the energy error.
struct Metric {
    std::function<double(const Summary&)> value;
    std::string title;
};

/// The extreme of an observable that the scene has.
double extremeOf(const Summary& summary, std::string_view observable) {
    for (const Summary::Extreme& each : summary.extremes)
        if (each.observable == observable) return each.value;
    return Summary::unknown;
}

Metric metricOf(const FigureContext& context) {
    for (const auto& scheme : context.comparison.schemes)
        if (std::isfinite(scheme->summary.maxError)) {
            if (context.system && context.system->error.evaluate)
                return {&Summary::maxError, axisTitle("max " + context.system->error.columns.front().symbol,
                                                      columnInfo(context, "error").unit)};
            const std::string q = context.system && context.system->dimension() == 1
                                      ? context.system->coordinates.front().symbol
                                      : "q";
            return {&Summary::maxError, axisTitle("max error in " + q, columnInfo(context, "error").unit)};
        }
    const std::string unit = context.system ? context.system->energyUnit : columnInfo(context, "energy").unit;
    const auto balance = [](const Summary& summary) { return extremeOf(summary, "balance"); };
    for (const auto& scheme : context.comparison.schemes)
        if (std::isfinite(balance(scheme->summary))) return {balance, axisTitle("max |H − H(0) − W|", unit)};
    return {&Summary::maxEnergyError, axisTitle("max |H − H(0)|", unit)};
}

Figure makeWorkPrecision(const FigureContext& context) {
    Figure figure = startFigure(context, "Speed against accuracy");
    const Metric metric = metricOf(context);
    figure.x = logAxis(axisTitle("CPU time", "s"));
    figure.y = logAxis(metric.title);
    for (const auto& scheme : context.comparison.schemes) {
        const Summary& summary = scheme->summary;
        if (summary.status != RunStatus::done) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.kind = SeriesKind::marks;
        s.x = {summary.cpuSeconds};
        s.y = {metric.value(summary)};
        figure.add(std::move(s));
    }
    figure.subtitle = "lower left is better";
    finishFigure(figure, context, "Largest error against CPU time");
    figure.drop<FailureMark>();  // a scheme without an error has no place here; its card and the other plots
                                 // tell
    return figure;
}

}  // namespace

RecipeEntry work_precision() { return {"work_precision", makeWorkPrecision}; }

}  // namespace extremal::recipes
