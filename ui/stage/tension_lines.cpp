// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/tension_lines.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "engine/model/parts/drawn_rods.hpp"

namespace extremal {
namespace {

/// A row and the part of the way to the next one.
struct RowAt {
    std::size_t row = 0, next = 0;
    double part = 0;
    double of(std::span<const double> values) const { return (1 - part) * values[row] + part * values[next]; }
};

RowAt rowAt(std::span<const double> times, double t) {
    const auto after = std::upper_bound(times.begin(), times.end(), t);
    if (after == times.begin()) return {};
    const auto row = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {row, row, 0};
    return {row, row + 1, (t - times[row]) / (times[row + 1] - times[row])};
}

}  // namespace

std::vector<TensionLine> tensionLines(const StagePlayer& player, double t) {
    std::vector<TensionLine> lines;
    const auto* const rods = player.system().parts.find<DrawnRods>();
    const Comparison* const comparison = player.comparison();
    if (!rods || !comparison || comparison->schemes.empty() || !comparison->schemes.front()) return lines;
    const Trajectory& rows = comparison->schemes.front()->trajectory;
    if (rows.rows() == 0) return lines;
    const RowAt at = rowAt(rows.columns.front().values, t);
    std::vector<double> x;
    for (const Quantity& column : stateColumns(player.system())) {
        const auto values = rows[column.name];
        if (values.size() != rows.rows()) return lines;
        x.push_back(at.of(values));
    }
    Drawing drawing;
    player.system().draw(x.data(), drawing);
    double largest = 0;
    for (const DrawnRods::Rod& rod : rods->all) {
        const auto values = rows["reaction." + rod.constraint];
        const auto* const segment =
            rod.shape < drawing.shapes.size() ? std::get_if<Segment>(&drawing.shapes[rod.shape]) : nullptr;
        if (!segment || values.size() != rows.rows()) continue;
        const double length = std::hypot(segment->b[0] - segment->a[0], segment->b[1] - segment->a[1]);
        for (const double v : values)
            if (std::isfinite(v)) largest = std::max(largest, 2 * length * std::abs(v));
        lines.push_back({segment->a, segment->b, -2 * length * at.of(values)});
    }
    std::erase_if(lines, [](const TensionLine& line) { return !std::isfinite(line.pull); });
    for (TensionLine& line : lines) line.pull /= largest > 0 ? largest : 1;
    return lines;
}

}  // namespace extremal
