// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {
namespace {

/// The lowest value from `at` on, in one direction, before one that is higher than `top`; infinity if there
/// is none.
template <class Values>
double valley(const Values& values, std::size_t at, double top, bool isForward) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = at; isForward ? ++i < values.size() : i-- > 0;) {
        if (!(values[i] > 0)) continue;
        if (values[i] > top) break;
        lowest = std::min(lowest, values[i]);
    }
    return lowest;
}

}  // namespace

std::vector<Peak> findPeaks(std::span<const double> values, double least) {
    std::vector<Peak> peaks;
    for (std::size_t first = 0; first < values.size();) {
        std::size_t last = first;
        while (last + 1 < values.size() && values[last + 1] == values[first]) ++last;
        const double top = values[first];
        const bool isInside = first > 0 && last + 1 < values.size();
        const bool isTop = isInside && top > 0 && !(values[first - 1] > top) && !(values[last + 1] > top);
        if (isTop) {
            const double base = std::max(valley(values, first, top, false), valley(values, last, top, true));
            if (std::isfinite(base) && top >= least * base) peaks.push_back({first, last, top / base});
        }
        first = last + 1;
    }
    return peaks;
}

}  // namespace extremal
