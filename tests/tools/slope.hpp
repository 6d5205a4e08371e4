// SPDX-License-Identifier: GPL-3.0-or-later
/// The order of a method from its errors over steps, both as logarithms.
#pragma once

#include <cstddef>
#include <vector>

namespace extremal {

/// Least-squares slope of y over x.
inline double slope(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double mx = 0, my = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mx += x[i] / n;
        my += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        sxx += (x[i] - mx) * (x[i] - mx);
        sxy += (x[i] - mx) * (y[i] - my);
    }
    return sxy / sxx;
}

}  // namespace extremal
