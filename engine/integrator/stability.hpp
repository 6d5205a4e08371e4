// SPDX-License-Identifier: GPL-3.0-or-later
/// Linear stability of a step: its map on the harmonic oscillator, as a function of z = step * frequency.
///
/// Symplectic maps of the plane have determinant 1: their eigenvalues are on the unit circle where half the
/// trace is at most 1 in size.
#pragma once

#include <functional>

namespace extremal {

/// First z at which the map has an eigenvalue outside the unit circle; 0 if it has one for every small z,
/// infinity if none is found below 60. `halfTrace(z)`: half the trace of the map. Intervals of instability
/// narrower than `resolution` (below z = 12; five times that above) may be missed.
double firstInstability(const std::function<double(double)>& halfTrace, double resolution = 0.004);

}  // namespace extremal
