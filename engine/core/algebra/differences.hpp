// SPDX-License-Identifier: GPL-3.0-or-later
/// A derivative by central differences of order 6, exact for polynomials of degree 6:
///     f'(x) = [45 (f_1 - f_-1) - 9 (f_2 - f_-2) + (f_3 - f_-3)] / (60 h),   f_j = f(x + j h).
#pragma once

namespace extremal {

/// Along one entry of what `value()` depends on, which is left as it was. Each difference is divided by the
/// distance that its two rounded places have.
template <class Value>
double slopeByDifferences(double& entry, double shift, Value&& value) {
    constexpr double weights[] = {45. / 60, -9. / 60, 1. / 60};
    const double here = entry;
    double sum = 0;
    for (int j = 1; j <= 3; ++j) {
        entry = here + j * shift;
        const double right = entry, above = value();
        entry = here - j * shift;
        const double below = value();
        sum += weights[j - 1] * (above - below) * (2 * j) / (right - entry);
    }
    entry = here;
    return sum;
}

}  // namespace extremal
