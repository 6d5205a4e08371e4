// SPDX-License-Identifier: GPL-3.0-or-later
/// Node times of a fixed grid of time: products, not sums, so that no round-off accumulates.
#pragma once

namespace extremal {

struct Clock {
    double start = 0;
    double step = 0;
    double at(long long node) const { return start + static_cast<double>(node) * step; }
};

}  // namespace extremal
