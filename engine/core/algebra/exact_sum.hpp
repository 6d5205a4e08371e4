// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums that keep what rounding takes from them: compensated summation.
#pragma once

namespace extremal {

/// a + b as rounded; `lost` is what rounding took, so that a + b = sum + lost exactly (Knuth, The Art of
/// Computer Programming 2, sec. 4.2.2). Added to the next b, it is lost no longer.
template <class T>
T addExactly(const T& a, const T& b, T& lost) {
    const T sum = a + b, back = sum - a;
    lost = (a - (sum - back)) + (b - back);
    return sum;
}

}  // namespace extremal
