// SPDX-License-Identifier: GPL-3.0-or-later
/// Ranges of axes that show the results rather than their accidents.
///
/// A scheme that blows up must not flatten the others, and the downward spikes of a logarithm where an error
/// changes its sign must not stretch the axis to round-off:
/// - failed schemes count only up to 1000 times (logarithmic) or 1 times (linear) the extent of the others;
/// - a logarithmic axis starts at the lowest of the series' 5 % quantiles, divided by 3, and spans at most 18
/// decades. The result is finite, increasing, and positive on logarithmic axes, whatever the data.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace extremal {

struct RangeInput {
    std::span<const double> values;  ///< NaN and, on logarithmic axes, values <= 0 are skipped
    bool hasFailed = false;
};

std::pair<double, double> fitRange(const std::vector<RangeInput>& inputs, bool isLog);

}  // namespace extremal
