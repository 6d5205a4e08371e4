// SPDX-License-Identifier: GPL-3.0-or-later
/// Motion in quadruple precision, by extrapolation of Gragg's midpoint rule: the truth that exact solutions
/// and references are measured against.
///
/// One step of length H takes 2, 4, .. 2K substeps and extrapolates to order 2K. Source: Hairer, Norsett,
/// Wanner, Solving Ordinary Differential Equations I (1993), sec. II.9.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <cstddef>
#include <vector>

namespace extremal {

/// x at t + H from x at t; `rate(t, x, dx)` on vectors of Quad.
template <class Rate>
std::vector<boost::multiprecision::float128> extrapolatedStep(
    Rate&& rate, const boost::multiprecision::float128& t,
    const std::vector<boost::multiprecision::float128>& x, const boost::multiprecision::float128& H) {
    using Number = boost::multiprecision::float128;
    constexpr int columns = 12;
    const std::size_t n = x.size();
    std::vector<std::vector<Number>> table;
    std::vector<Number> slope(n), first(n), before, here;
    rate(t, x, first);
    for (int k = 0; k < columns; ++k) {
        const int parts = 2 * (k + 1);
        const Number h = H / parts;
        before = x;
        here = x;
        for (std::size_t i = 0; i < n; ++i) here[i] += h * first[i];
        for (int j = 1; j < parts; ++j) {
            rate(Number(t + j * h), here, slope);
            for (std::size_t i = 0; i < n; ++i) before[i] += 2 * h * slope[i];
            before.swap(here);
        }
        table.push_back(here);
        // Aitken and Neville in h^2, from the last row to the first.
        for (int j = k; j-- > 0;) {
            const Number ratio = Number(parts) / (2 * (j + 1));
            auto &low = table[static_cast<std::size_t>(j)], &high = table[static_cast<std::size_t>(j) + 1];
            for (std::size_t i = 0; i < n; ++i) low[i] = high[i] + (high[i] - low[i]) / (ratio * ratio - 1);
        }
    }
    return table.front();
}

}  // namespace extremal
