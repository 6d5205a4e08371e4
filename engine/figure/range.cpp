// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/range.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

constexpr double largest = 1e280;  // beyond, differences and paddings overflow

std::vector<double> usable(std::span<const double> values, bool isLog) {
    std::vector<double> result;
    result.reserve(values.size());
    for (double v : values)
        if (std::isfinite(v) && std::abs(v) < largest && (!isLog || v > 1e-290))
            result.push_back(isLog ? std::log10(v) : v);
    return result;
}

double quantile(std::vector<double>& values, double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return values[static_cast<std::size_t>(k)];
}

struct SeriesExtent {
    double low = 0, high = 0;
    bool isEmpty = true;
    void include(double a, double b) {
        low = isEmpty ? a : std::min(low, a);
        high = isEmpty ? b : std::max(high, b);
        isEmpty = false;
    }
};

/// Extent of one series in axis space (log10 on logarithmic axes).
SeriesExtent seriesExtent(std::vector<double> values, bool isLog, bool isTamed) {
    SeriesExtent e;
    if (values.empty()) return e;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    e.include(*low, *high);
    if (isLog && values.size() >= 20) e.low = std::max(e.low, quantile(values, 0.05) - std::log10(3.0));
    if (isTamed) {  // nothing else to compare with: the middle of the series says what is normal
        const double middle = quantile(values, 0.5);
        if (isLog) {
            e.high = std::min(e.high, middle + 6);
        } else {
            for (double& v : values) v = std::abs(v);
            const double typical = std::max(20 * quantile(values, 0.5), 1e-280);
            e.low = std::max(e.low, -typical);
            e.high = std::min(e.high, typical);
        }
    }
    return e;
}

std::pair<double, double> padded(SeriesExtent e, bool isLog) {
    if (isLog) {
        e.low = std::max(e.low, e.high - 18);
        const double missing = std::max(0.0, 1 - (e.high - e.low));  // at least a decade
        const double pad = 0.04 * (e.high - e.low) + missing / 2 + 0.05;
        return {std::pow(10, e.low - pad), std::pow(10, e.high + pad)};
    }
    const double scale = std::max(std::abs(e.low), std::abs(e.high));
    const bool isConstant = e.high - e.low <= 1e-12 * scale || scale == 0;
    const double pad = isConstant ? (scale > 0 ? 0.1 * scale : 1) : 0.06 * (e.high - e.low);
    return {e.low - pad, e.high + pad};
}

}  // namespace

std::pair<double, double> fitRange(const std::vector<RangeInput>& inputs, bool isLog) {
    SeriesExtent good, bad;
    for (const RangeInput& in : inputs)
        if (!in.hasFailed)
            if (const SeriesExtent e = seriesExtent(usable(in.values, isLog), isLog, false); !e.isEmpty)
                good.include(e.low, e.high);
    for (const RangeInput& in : inputs)
        if (in.hasFailed)
            if (const SeriesExtent e = seriesExtent(usable(in.values, isLog), isLog, good.isEmpty);
                !e.isEmpty)
                bad.include(e.low, e.high);
    if (good.isEmpty && bad.isEmpty) return isLog ? std::pair{1e-16, 1.0} : std::pair{0.0, 1.0};
    if (good.isEmpty) return padded(bad, isLog);
    if (!bad.isEmpty) {
        const double room = isLog ? 3 : (good.high - good.low) / 2;
        good.include(std::max(bad.low, good.low - room), std::min(bad.high, good.high + room));
    }
    return padded(good, isLog);
}

}  // namespace extremal
