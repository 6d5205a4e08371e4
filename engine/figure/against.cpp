// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/against.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

/// The least and the most of the numbers of steps that can be shown.
std::optional<std::pair<double, double>> stepsCovered(const Figure& figure) {
    double first = 0, last = 0;
    for (const Series& s : figure.series())
        for (const double n : s.x) {
            if (!(n > 0)) continue;
            first = first > 0 ? std::min(first, n) : n;
            last = std::max(last, n);
        }
    if (!(last > first)) return {};
    return std::pair{first, last};
}

}  // namespace

std::string againstText(const View& view) {
    return isAgainstSteps(view) ? "against the number of steps" : "against time";
}

void addErrors(Figure& figure, const FigureContext& context, std::string_view column) {
    const bool isSteps = isAgainstSteps(context.view);
    figure.x = isSteps ? logAxis("steps") : timeAxis(context);
    for (const auto& scheme : context.comparison.schemes) {
        const Trajectory& rows = scheme->trajectory;
        const std::span<const double> x = isSteps ? std::span<const double>(rows.nodes) : rows["t"],
                                      y = rows[column];
        if (y.empty() || x.size() != y.size()) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x.assign(x.begin(), x.end());
        if (isSteps) s.t.assign(rows["t"].begin(), rows["t"].end());
        for (const double v : y) s.y.push_back(std::abs(v));
        figure.add(std::move(s));
    }
    if (!isSteps) return;
    if (const auto covered = stepsCovered(figure))
        figure.x.range = {covered->first / 1.25, covered->second * 1.25};
}

std::string leastToMost(const std::vector<std::pair<double, std::string>>& values) {
    if (values.empty()) return "";
    const auto [least, most] = std::minmax_element(
        values.begin(), values.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto text = [](const auto& value) {
        return shortNumber(value->first) + " (" + value->second + ")";
    };
    return least == most ? text(least) : text(least) + " to " + text(most);
}

void addChance(Figure& figure, const FigureContext& context) {
    const auto covered = stepsCovered(figure);
    if (!isAgainstSteps(context.view) || !(floorOf(figure) > 0) || !covered) return;
    Series chance;
    chance.label = "round-off by chance, ∝ √steps";
    chance.style = formulaStyle;
    chance.x = {covered->first, covered->second};
    chance.y = {floorOf(figure) * std::sqrt(covered->first), floorOf(figure) * std::sqrt(covered->second)};
    figure.add(std::move(chance));
}

}  // namespace extremal
