// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/fit_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/core/text/expression.hpp"
#include "engine/figure/range.hpp"

namespace extremal {
namespace {

/// The values of a series between two places along x. Lines are cut there, so that one whose points are all
/// outside counts.
std::vector<double> valuesWithin(const Series& s, std::pair<double, double> part) {
    std::vector<double> inside;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (s.x[i] >= part.first && s.x[i] <= part.second) inside.push_back(s.y[i]);
        if (!hasLine(s.kind) || i == 0) continue;
        for (const double edge : {part.first, part.second}) {
            const double before = s.x[i - 1] - edge, after = s.x[i] - edge;
            if (before * after < 0)
                inside.push_back(s.y[i - 1] + (s.y[i] - s.y[i - 1]) * before / (before - after));
        }
    }
    return inside;
}

/// The largest values over equal parts of a logarithmic axis: those of the first decades count as much as the
/// many of the last.
std::vector<double> valuesByRatio(const Series& s) {
    constexpr std::size_t parts = 300;
    double first = std::numeric_limits<double>::infinity(), last = 0;
    for (const double x : s.x)
        if (x > 0 && std::isfinite(x)) first = std::min(first, x), last = std::max(last, x);
    if (s.x.size() <= parts || !(last > first)) return s.y;
    const double width = std::log(last / first) / static_cast<double>(parts);
    std::vector<double> largest;
    double end = -1;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (!(s.x[i] > 0) || !std::isfinite(s.y[i])) continue;
        const double at = std::log(s.x[i] / first);
        if (at >= end) {
            largest.push_back(s.y[i]);
            end = at + width;
        } else {
            largest.back() = std::max(largest.back(), s.y[i]);
        }
    }
    return largest;
}

/// The range that fits the values of all series, or those in a part of x.
std::pair<double, double> fitted(const Figure& figure, std::vector<double> Series::*values, bool isLog,
                                 const std::optional<std::pair<double, double>>& part = {}) {
    std::set<std::string> failed;
    for (const FailureMark& f : figure.all<FailureMark>()) failed.insert(f.label);
    std::vector<std::vector<double>> cut;
    cut.reserve(figure.series().size());
    std::vector<RangeInput> inputs;
    for (const Series& s : figure.series()) {
        const bool isOverX = s.kind == SeriesKind::line || s.kind == SeriesKind::markedLine;
        const bool isByRatio = !part && figure.x.isLog && values == &Series::y && isOverX;
        if (part) cut.push_back(valuesWithin(s, *part));
        if (isByRatio) cut.push_back(valuesByRatio(s));
        inputs.push_back({part || isByRatio ? cut.back() : s.*values, failed.count(s.label) > 0});
    }
    return fitRange(inputs, isLog);
}

std::optional<std::pair<double, double>> askedFor(const std::optional<ViewRange>& range) {
    if (!range) return {};
    return std::pair{range->low.value, range->high.value};
}

}  // namespace

Series formulaSeries(const ViewCurve& curve, const std::string& variable, double low, double high,
                     bool isLog) {
    constexpr std::size_t fewest = 4000, most = 16 * fewest;
    const Expression expression = parseExpression(curve.expression);
    const auto valueAt = [&](double x) {
        const double y = evaluate(expression, [&](std::string_view name) -> std::optional<double> {
            if (name == variable) return x;
            for (const auto& [known, value] : curve.values)
                if (name == known) return value;
            return {};
        });
        return std::isfinite(y) ? y : std::numeric_limits<double>::quiet_NaN();
    };
    Series s;
    s.label = curve.expression;
    s.style = formulaStyle;
    const auto placeOf = [&](std::size_t i, std::size_t n) {
        const double part = static_cast<double>(i) / static_cast<double>(n);
        return isLog ? low * std::pow(high / low, part) : low + (high - low) * part;
    };
    std::size_t n = fewest;
    for (std::size_t i = 0; i <= n; ++i) s.y.push_back(valueAt(placeOf(i, n)));
    for (;;) {  // twice as many points, of which every second one is known
        std::vector<double> finer;
        finer.reserve(2 * n + 1);
        double deviation = 0, least = std::numeric_limits<double>::infinity(), greatest = -least;
        for (std::size_t i = 0; i < n; ++i) {
            const double middle = valueAt(placeOf(2 * i + 1, 2 * n)), chord = (s.y[i] + s.y[i + 1]) / 2;
            finer.insert(finer.end(), {s.y[i], middle});
            if (std::isfinite(middle - chord)) deviation = std::max(deviation, std::abs(middle - chord));
            if (std::isfinite(middle)) least = std::min(least, middle), greatest = std::max(greatest, middle);
        }
        if (!(deviation > 0.01 * (greatest - least))) break;
        if (n == most) {
            s.label += " (too fast for this range)";
            break;
        }
        finer.push_back(s.y.back());
        s.y = std::move(finer);
        n *= 2;
    }
    for (std::size_t i = 0; i <= n; ++i) s.x.push_back(placeOf(i, n));
    return s;
}

void fitAxes(Figure& figure, const View& view, const std::string& variable) {
    Axis &x = figure.x, &y = figure.y;
    if (!x.range) x.range = fitted(figure, &Series::x, x.isLog);
    const auto xAsked = askedFor(view.xRange), yAsked = askedFor(view.yRange);
    const auto wholeX = *x.range;
    if (xAsked) x.range = xAsked;
    if (!view.curve.expression.empty() && !variable.empty()) {
        Series s = formulaSeries(view.curve, variable, x.range->first, x.range->second, x.isLog);
        for (double& v : s.y)
            if (y.isLog && v <= 0) v = std::numeric_limits<double>::quiet_NaN(), ++s.hidden;
        figure.add(std::move(s));
    }
    const auto wholeY = y.range ? *y.range : fitted(figure, &Series::y, y.isLog);
    if (yAsked)
        y.range = yAsked;
    else if (xAsked && !y.range)
        y.range = fitted(figure, &Series::y, y.isLog, xAsked);
    else
        y.range = wholeY;
    if (!xAsked && !yAsked) return;
    x.whole = wholeX;
    y.whole = wholeY;
    const auto isPart = [](const Axis& axis) {
        return axis.range->first > axis.whole->first || axis.range->second < axis.whole->second;
    };
    if ((xAsked && isPart(x)) || (yAsked && isPart(y)))
        figure.subtitle += figure.subtitle.empty() ? "zoomed" : " · zoomed";
}

}  // namespace extremal
