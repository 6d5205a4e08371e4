/// The stability limit of a composition, measured: its map on the harmonic oscillator, from two steps of the
/// scheme itself.
#pragma once

#include "engine/scene/resolve.hpp"

namespace extremal {

/// Largest step times frequency; infinity: none below 60; 0: the scheme does not run on the oscillator (rigid
/// bodies). Remembered, so asking again is cheap.
double composedStabilityLimit(const ResolvedScheme& scheme);

}  // namespace extremal
