// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/trend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace extremal {
namespace {

using Values = std::span<const double>;

constexpr std::size_t mostBlocks = 48, fewestBlocks = 16;
constexpr double smallPart = 0.05;        // of the fluctuation
constexpr double oneDirection = 0.9;      // of Kendall's tau
constexpr double levelsApart = 4;         // ranges
constexpr double fewestIndependent = 12;  // blocks
constexpr double certain = 5;             // standard errors

double meanOf(Values z) { return std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size()); }

double rangeOf(Values z) {
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    return *high - *low;
}

double kendallTau(Values z) {
    double sum = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
        for (std::size_t j = i + 1; j < z.size(); ++j) sum += z[j] > z[i] ? 1 : z[j] < z[i] ? -1 : 0;
    return 2 * sum / (static_cast<double>(z.size()) * static_cast<double>(z.size() - 1));
}

/// In blocks; `residuals` have mean 0.
double autocorrelationTime(Values residuals) {
    const double variance = std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
    if (variance == 0) return 1;
    double time = 1;
    for (std::size_t lag = 1; lag < residuals.size() / 2; ++lag) {
        const Values late = residuals.subspan(lag);
        const double product = std::inner_product(late.begin(), late.end(), residuals.begin(), 0.0);
        if (product <= 0) break;
        time += 2 * product / variance;
    }
    return time;
}

struct Line {
    double change, uncertainty;  ///< over the run, and its standard error
    double independent;          ///< N
};

Line fitLine(Values z) {
    const auto m = static_cast<double>(z.size());
    const double mean = meanOf(z);
    const auto place = [&](std::size_t i) { return (static_cast<double>(i) + 0.5) / m - 0.5; };
    double product = 0, square = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        product += place(i) * (z[i] - mean);
        square += place(i) * place(i);
    }
    const double change = product / square;
    std::vector<double> residuals;
    double sum = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        residuals.push_back(z[i] - mean - change * place(i));
        sum += residuals.back() * residuals.back();
    }
    const double time = autocorrelationTime(residuals);
    return {change, std::sqrt(sum / (m - 2) * 12 / m * time), m / time};
}

Trend trendOfBlocks(Values z, double fluctuation) {
    const double small = smallPart * fluctuation;
    if (rangeOf(z) <= small) return Trend::none;
    if (std::abs(kendallTau(z)) >= oneDirection) return Trend::drift;
    const Values early = z.first(z.size() / 2), late = z.subspan(z.size() / 2);
    if (std::abs(z.front() - meanOf(late)) > levelsApart * rangeOf(late) ||
        std::abs(z.back() - meanOf(early)) > levelsApart * rangeOf(early))
        return Trend::open;
    const Line line = fitLine(z);
    if (line.independent < fewestIndependent) return Trend::open;
    const double change = std::abs(line.change);
    return change > certain * line.uncertainty && change > small ? Trend::drift : Trend::none;
}

}  // namespace

Trend trendOf(std::span<const double> values, double noise) {
    std::vector<double> known;
    double largest = 0;
    for (const double value : values) {
        if (std::isinf(value)) return Trend::drift;
        if (std::isnan(value)) continue;
        known.push_back(value);
        largest = std::max(largest, std::abs(value));
    }
    if (largest <= noise) return known.empty() ? Trend::open : Trend::none;
    const std::size_t n = known.size(), m = std::min(mostBlocks, n / 2);
    if (m < fewestBlocks) return Trend::open;
    // Sums of values near the largest number overflow; no comparison below depends on the unit.
    for (double& value : known) value /= largest;
    std::vector<double> means, halfRanges;
    for (std::size_t i = 0; i < m; ++i) {
        const Values block = Values(known).subspan(i * n / m, (i + 1) * n / m - i * n / m);
        means.push_back(meanOf(block));
        halfRanges.push_back(rangeOf(block) / 2);
    }
    const double fluctuation = rangeOf(known) / 2;
    const Trend level = trendOfBlocks(means, fluctuation), size = trendOfBlocks(halfRanges, fluctuation);
    if (level == Trend::drift || size == Trend::drift) return Trend::drift;
    return level == Trend::open || size == Trend::open ? Trend::open : Trend::none;
}

}  // namespace extremal
