// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/sample.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"

namespace extremal {

std::optional<std::pair<double, double>> pointAt(const Series& series, double t) {
    const std::vector<double>& time =
        series.kind == SeriesKind::curve || !series.t.empty() ? series.t : series.x;
    if (time.size() != series.y.size() || time.empty() || hasMarks(series.kind) ||
        series.kind == SeriesKind::cells)
        return {};
    if (!(t >= time.front() && t <= time.back())) return {};
    const auto next = std::upper_bound(time.begin(), time.end(), t);
    const std::size_t b =
        std::min<std::size_t>(static_cast<std::size_t>(next - time.begin()), time.size() - 1);
    const std::size_t a = b == 0 ? 0 : b - 1;
    const double span = time[b] - time[a];
    const double part = span > 0 ? std::clamp((t - time[a]) / span, 0.0, 1.0) : 1;
    const double w = series.isSparse ? std::round(part) : part;
    const auto between = [w](double from, double to) {
        return w == 0 ? from : w == 1 ? to : from + w * (to - from);
    };
    const double x = between(series.x[a], series.x[b]), y = between(series.y[a], series.y[b]);
    if (!std::isfinite(x) || !std::isfinite(y)) return {};
    return std::pair{x, y};
}

namespace {

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

std::string cell(double value) { return std::isfinite(value) ? formatNumber(value) : std::string(); }

bool isWithin(double value, const Axis& axis) {
    return !axis.range || (value >= axis.range->first && value <= axis.range->second);
}

}  // namespace

namespace {

/// "k  [N/m]" and 100: "k = 100 N/m".
std::string withTitle(const std::string& title, const std::string& value) {
    const std::size_t unit = title.find("  [");
    if (unit == std::string::npos) return title + " = " + value;
    return title.substr(0, unit) + " = " + value + " " + title.substr(unit + 3, title.size() - unit - 4);
}

/// Row by row of the grid: the value itself, and why there is none.
std::string heatCsv(const Figure& figure, bool isVisibleOnly) {
    const HeatMap& heat = *figure.heat();
    std::string csv =
        quoted(figure.x.title) + "," + quoted(figure.y.title) + "," + quoted(heat.scale) + ",outcome\n";
    for (std::size_t c = 0; c < heat.xs.size(); ++c)
        for (std::size_t r = 0; r < heat.ys.size(); ++r) {
            if (isVisibleOnly && !(isWithin(heat.xs[c], figure.x) && isWithin(heat.ys[r], figure.y)))
                continue;
            const std::size_t i = c * heat.ys.size() + r;
            csv += cell(heat.xs[c]) + "," + cell(heat.ys[r]) + "," + cell(heat.values[i]) + "," +
                   quoted(heat.faults[i]) + "\n";
        }
    return csv;
}

}  // namespace

std::optional<HeatCell> cellAt(const Figure& figure, double x, double y) {
    if (!figure.heat() || figure.heat()->scale.empty()) return {};
    const HeatMap& heat = *figure.heat();
    const auto indexOf = [](double value, double low, double high, int count, bool isLog) {
        const double part =
            isLog ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        return part >= 0 && part < 1 ? static_cast<int>(part * count) : -1;
    };
    const int column = indexOf(x, heat.left, heat.right, heat.columns, figure.x.isLog),
              row = indexOf(y, heat.bottom, heat.top, heat.rows, figure.y.isLog);
    if (column < 0 || row < 0) return {};
    const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row),
               i = c * heat.ys.size() + r;
    const bool hasValue = std::isfinite(heat.values[i]);
    std::string text = withTitle(figure.x.title, formatNumber(heat.xs[c], 6)) + ", " +
                       withTitle(figure.y.title, formatNumber(heat.ys[r], 6)) + "\n";
    if (hasValue)
        text += withTitle(heat.scale, formatNumber(heat.values[i], 3)) +
                (heat.faults[i].empty() ? "" : ", " + heat.faults[i]);
    else
        text += heat.faults[i].empty() ? "not known" : heat.faults[i];
    return HeatCell{c, r, heat.xs[c], heat.ys[r], std::move(text)};
}

std::string seriesName(const Series& series) {
    return series.part.empty() ? series.label : series.label + ", " + series.part;
}

std::string figureCsv(const Figure& figure, bool isVisibleOnly) {
    if (figure.heat() && !figure.heat()->scale.empty()) return heatCsv(figure, isVisibleOnly);
    std::string csv = "scheme," + quoted(figure.x.title) + "," + quoted(figure.y.title) + "\n";
    for (const Series& s : figure.series()) {
        const std::string label = quoted(seriesName(s));
        for (std::size_t r = 0; r < s.x.size(); ++r) {
            if (isVisibleOnly &&
                !(isWithin(s.x[r], figure.x) && (isWithin(s.y[r], figure.y) || std::isnan(s.y[r]))))
                continue;
            csv.append(label).append(",").append(cell(s.x[r])).append(",").append(cell(s.y[r])).append("\n");
        }
    }
    return csv;
}

}  // namespace extremal
