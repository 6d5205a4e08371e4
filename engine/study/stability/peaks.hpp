// SPDX-License-Identifier: GPL-3.0-or-later
/// Peaks of a curve, as resonances make them: values that stand out from both sides.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace extremal {

struct Peak {
    std::size_t first = 0, last = 0;  ///< of equal values, infinite ones mostly
    double prominence = 0;            ///< over the higher one of the two valleys beside it; a ratio
};

/// Of values that are positive or infinite; others are gaps, which nothing stands out from. A peak is at
/// least `least` times as high as the lowest value on each side before one that is higher; an end of the
/// curve is not a peak.
std::vector<Peak> findPeaks(std::span<const double> values, double least);

}  // namespace extremal
