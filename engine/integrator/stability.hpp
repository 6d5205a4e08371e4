// SPDX-License-Identifier: GPL-3.0-or-later
/// Linear stability of a step: where its map on the harmonic oscillator begins to grow, as a function of
/// z = step * frequency. One search for all: what differs is who says whether a z is stable.
#pragma once

#include <functional>
#include <limits>

namespace extremal {

/// Where is looked: from 0.01 on by `fine` below `fineEnd`, then from z to ratio * z + coarse, below `end`.
/// Intervals of instability that are narrower may be missed.
struct StabilityScan {
    double fine = 0.004, fineEnd = 12, coarse = 0.02, ratio = 1, end = 60;
};

/// Neighbouring numbers about the first z that is not stable; low 0: not even a small one is.
struct StabilityEdge {
    double low = 0,
           high = std::numeric_limits<double>::infinity();  ///< infinite: stable as far as was looked
    bool isFound() const { return high < std::numeric_limits<double>::infinity(); }
    /// The limit as one number: 0 where no small z is stable, infinity where no edge was found.
    double limit() const { return isFound() ? low : high; }
};

StabilityEdge firstInstability(const std::function<bool(double)>& isStable, const StabilityScan& scan = {});

/// Of a symplectic map of the plane, whose determinant is 1: its eigenvalues are on the unit circle where
/// half the trace is at most 1 in size. The slack is the round-off of a half trace that grows like z^2.
bool hasBoundedPowers(double halfTrace, double z);

}  // namespace extremal
