// SPDX-License-Identifier: GPL-3.0-or-later
/// How an estimate of an error compares with the error.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace extremal {

/// The least and the largest ratio of estimate and error over the rows with an error above `floor`.
struct EstimateRatio {
    EstimateRatio(std::span<const double> estimate, std::span<const double> error, double floor) {
        for (std::size_t k = 0; k < error.size(); ++k) {
            if (!(error[k] > floor)) continue;
            low = std::min(low, estimate[k] / error[k]);
            high = std::max(high, estimate[k] / error[k]);
            ++rows;
        }
    }
    double low = INFINITY, high = 0;
    int rows = 0;
};

}  // namespace extremal
