// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors that a run cannot resolve: below them, errors say nothing of the scheme.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/state.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// The size of a state that the round-off of a run is measured by.
inline double largestEntry(const State& state) {
    double size = 0;
    for (const double v : state.x) size = std::max(size, std::abs(v));
    return size;
}

/// Ten times the reference's own error; 0 where it is not known.
inline double referenceFloor(const ReferenceInfo& reference) {
    return std::isfinite(reference.estimatedError) ? 10 * reference.estimatedError : 0;
}

/// Largest error that round-off explains after so many steps, for a state of this size: the worst case, for
/// errors that grow, where every step adds its own.
inline double roundOffFloor(double scale, long long steps) {
    return 2.2e-15 * scale * static_cast<double>(steps);
}

/// Fills the floor of a run and what it is of; a caution where its error is below the floor of a doubtful
/// reference, and where its steps may miss a pulse of the force. `scale`: as above.
void noteFloor(SchemeResult& result, const ReferenceInfo& reference, double scale);

}  // namespace extremal
