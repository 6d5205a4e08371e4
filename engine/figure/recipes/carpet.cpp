// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over time and space as a heat map; wave functions with their phase as the colour, those over a
/// rectangle as their density along x. Over that of a moving mesh the paths of its nodes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/figure/build.hpp"
#include "engine/scene/bind.hpp"

namespace extremal::recipes {
namespace {

constexpr int mostColumns = 800, mostRows = 400, interpolatedRows = 256;

/// sqrt of the integral of |psi|^2 or u^2 over y, at the nodes along x.
std::vector<double> marginal(const FieldSampling& field, const std::vector<double>& values) {
    const std::size_t columns = field.x.size(), n = field.places();
    std::vector<double> sums(columns);
    for (std::size_t j = 0; j < n; ++j)
        sums[j % columns] += values[j] * values[j] + (field.isComplex ? values[n + j] * values[n + j] : 0);
    for (double& sum : sums) sum = std::sqrt(sum * field.across.length / static_cast<double>(field.y.size()));
    return sums;
}

/// A field at the middles of equal rows, linear between its nodes, which may be anywhere.
std::vector<double> atRows(const FieldSampling& field, const std::vector<double>& values, double bottom,
                           double top, int rows) {
    const std::span<const double> nodes = field.nodesOf(values);
    const std::size_t n = nodes.size();
    std::vector<double> at;
    std::size_t j = 0;
    for (int row = 0; row < rows; ++row) {
        const double x = bottom + (top - bottom) * (row + 0.5) / rows;
        while (j + 1 < n && nodes[j + 1] <= x) ++j;
        const bool isLast = j + 1 == n;  // of a periodic field; else the last node is the end
        const double right = isLast ? nodes[0] + field.period : nodes[j + 1],
                     next = isLast ? values[0] : values[j + 1];
        const double part = right > nodes[j] ? (x - nodes[j]) / (right - nodes[j]) : 0;
        at.push_back(values[j] + part * (next - values[j]));
    }
    return at;
}

HeatMap heatOf(const System& system, const SchemeResult& scheme, double start, double end) {
    const FieldSampling& field = system.field;
    const std::vector<Frame>& frames = *framesOf(scheme);
    const bool isRectangle = !field.y.empty(), isComplex = field.isComplex && !isRectangle;
    const bool isScalar = !field.isComplex && !isRectangle;
    const bool isUneven = static_cast<bool>(field.resampling);
    const FieldSampling::Resampling evenly =
        isUneven ? field.resampling(interpolatedRows) : FieldSampling::Resampling();
    const std::size_t n = isUneven ? interpolatedRows : field.x.size();
    HeatMap heat;
    heat.columns = static_cast<int>(std::min<std::size_t>(frames.size(), mostColumns));
    heat.rows = static_cast<int>(std::min<std::size_t>(n, mostRows));
    const double step = isUneven ? 0 : n > 1 ? field.x[1] - field.x[0] : 1;
    heat.left = start;
    heat.right = end;
    heat.bottom = field.x.front();
    heat.top = field.x.back() + step;
    if (isScalar) heat.top = field.period > 0 ? heat.bottom + field.period : field.x.back();
    if (isUneven) {
        heat.bottom = field.along.left;
        heat.top = heat.bottom + field.along.length;
    }
    const double last = frames.back().t, seconds = end - start;
    for (int column = 0; column < heat.columns; ++column) {
        const double t = start + seconds * (column + 0.5) / heat.columns;
        auto after = std::lower_bound(frames.begin(), frames.end(), t,
                                      [](const Frame& f, double at) { return f.t < at; });
        if (after == frames.end() || (after != frames.begin() && t - (after - 1)->t < after->t - t)) --after;
        const bool isThere = t <= last + seconds / heat.columns;
        const std::vector<double> made = isUneven ? evenly(*after->values)
                                         : isScalar
                                             ? atRows(field, *after->values, heat.bottom, heat.top, heat.rows)
                                         : isRectangle ? marginal(field, *after->values)
                                                       : std::vector<double>();
        const std::vector<double>& values = made.empty() ? *after->values : made;
        for (int row = 0; row < heat.rows; ++row) {
            const auto j = isScalar
                               ? static_cast<std::size_t>(row)
                               : static_cast<std::size_t>((row + 0.5) * static_cast<double>(n) / heat.rows);
            const double a = values[j], b = isComplex ? values[n + j] : 0;
            heat.values.push_back(!isThere ? Summary::unknown : isComplex ? std::hypot(a, b) : a);
            if (isComplex) heat.hues.push_back(std::atan2(b, a) / (2 * std::numbers::pi));
        }
    }
    heat.high = maxMagnitude(heat.values);
    if (!isComplex) heat.low = isRectangle ? 0 : -heat.high;
    return heat;
}

/// The paths of the nodes, of many every m-th.
Guide pathsOf(const FieldSampling& field, const std::vector<Frame>& frames) {
    constexpr std::size_t mostPaths = 24;
    const std::size_t n = field.x.size(), stride = (n + mostPaths - 1) / mostPaths;
    Guide guide;
    guide.isStrong = true;
    for (std::size_t i = 0; i < n; i += stride) {
        for (const Frame& frame : frames) {
            guide.x.push_back(frame.t);
            guide.y.push_back(field.nodesOf(*frame.values)[i]);
        }
        guide.x.push_back(Summary::unknown);
        guide.y.push_back(Summary::unknown);
    }
    return guide;
}

Figure makeCarpet(const FigureContext& context) {
    Figure figure = startFigure(context, context.entry.item.title);
    figure.x = timeAxis(context);
    figure.y.title = "x";
    const SchemeResult* scheme =
        schemeOf(context, [](const SchemeResult& s) { return framesOf(s) != nullptr; });
    if (scheme && context.system && context.system->field) {
        const auto& time = context.comparison.scene;
        figure.title = "Carpet of " + scheme->spec.label;
        figure.add(heatOf(systemOf(context, *scheme), *scheme, timeSpan(time).first, timeSpan(time).last));
        figure.y.range = {figure.heat()->bottom, figure.heat()->top};
        const FieldSampling& own = systemOf(context, *scheme).field;
        if (own.hasMovingNodes) figure.add(pathsOf(own, *framesOf(*scheme)));
        const std::string most = " · at most " + shortNumber(figure.heat()->high);
        if (!figure.heat()->hues.empty()) figure.subtitle = "|ψ|, the colour is its phase" + most;
        if (!own.isComplex) figure.subtitle = "u" + most;
        if (!own.y.empty())
            figure.subtitle = (!own.isComplex                   ? "√∫u² dy"
                               : own.components.front() == "re" ? "√∫|ψ|² dy"
                                                                : "√∫|u|² dy") +
                              most;
    } else if (context.system && !context.system->field) {
        figure.message = "The model is not a field";
    }
    finishFigure(figure, context, "Field over time and space");
    return figure;
}

}  // namespace

RecipeEntry carpet() { return {"carpet", makeCarpet}; }

}  // namespace extremal::recipes
