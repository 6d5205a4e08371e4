// SPDX-License-Identifier: GPL-3.0-or-later
/// An interval of z = step * frequency in which a step on the harmonic oscillator is unstable.
#pragma once

#include <vector>

namespace extremal {

/// Half the trace is beyond 1 in magnitude for low < z < high.
struct UnstableInterval {
    double low = 0, high = 0;  ///< high: infinity where every longer step is unstable
    double growth = 0;  ///< largest logarithm of the magnification of a step; infinity if it has no bound
    bool isBounded() const { return high <= 1e300; }
};

/// The first end of an interval: 0 if short steps are unstable, infinity if all are stable.
double firstEdge(const std::vector<UnstableInterval>& intervals);

}  // namespace extremal
