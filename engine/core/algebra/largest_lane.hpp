// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest of eight numbers without a decision, for kernels over Lanes.
#pragma once

namespace extremal {

/// One instruction, which a NaN in a escapes.
inline double larger(double a, double b) { return b > a ? b : a; }
/// Of eight; uses the array up.
inline double largestLane(double* v) {
    for (int l = 0; l < 4; ++l) v[l] = larger(v[l], v[l + 4]);
    for (int l = 0; l < 2; ++l) v[l] = larger(v[l], v[l + 2]);
    return larger(v[0], v[1]);
}

}  // namespace extremal
