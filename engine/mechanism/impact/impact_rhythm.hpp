// SPDX-License-Identifier: GPL-3.0-or-later
/// The last impacts on one wall, whose distances in time tell whether they accumulate.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace extremal {

struct ImpactRhythm {
    double last[4] = {};
    int known = 0;

    void add(double t) {
        if (known == 4) {
            std::copy(last + 1, last + 4, last);
            --known;
        }
        last[known++] = t;
    }
    /// Where infinitely many impacts have passed, if their distances shrink by one factor.
    std::optional<double> end() const {
        if (known < 4) return {};
        const double first = last[1] - last[0], second = last[2] - last[1], third = last[3] - last[2];
        const double r = third / second;
        if (!(r > 0 && r < 1) || !(std::abs(second / first / r - 1) < 1e-3)) return {};
        return last[3] + third * r / (1 - r);
    }
    /// That time, if it is this close to t; else t.
    double endNear(double t, double within) const {
        const auto infinitelyMany = end();
        return infinitelyMany && std::abs(*infinitelyMany - t) < within ? *infinitelyMany : t;
    }
};

}  // namespace extremal
