#include "engine/figure/sample.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text.hpp"

namespace extremal {

std::optional<std::pair<double, double>> pointAt(const Series& series, double t) {
    const std::vector<double>& time = series.isCurve ? series.t : series.x;
    if (time.size() != series.y.size() || time.empty() || series.hasMarkers || series.isCells) return {};
    if (!(t >= time.front() && t <= time.back())) return {};
    const auto next = std::upper_bound(time.begin(), time.end(), t);
    const std::size_t b = std::min<std::size_t>(static_cast<std::size_t>(next - time.begin()), time.size() - 1);
    const std::size_t a = b == 0 ? 0 : b - 1;
    const double span = time[b] - time[a];
    const double w = span > 0 ? std::clamp((t - time[a]) / span, 0.0, 1.0) : 1;
    const auto between = [w](double from, double to) { return w == 0 ? from : w == 1 ? to : from + w * (to - from); };
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

std::string figureCsv(const Figure& figure, bool isVisibleOnly) {
    std::string csv = "scheme," + quoted(figure.x.title) + "," + quoted(figure.y.title) + "\n";
    for (const Series& s : figure.series) {
        const std::string label = quoted(s.label);
        for (std::size_t r = 0; r < s.x.size(); ++r) {
            if (isVisibleOnly && !(isWithin(s.x[r], figure.x) && (isWithin(s.y[r], figure.y) || std::isnan(s.y[r])))) continue;
            csv.append(label).append(",").append(cell(s.x[r])).append(",").append(cell(s.y[r])).append("\n");
        }
    }
    return csv;
}

}  // namespace extremal
