// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/stability.hpp"

#include <cmath>

namespace extremal {

StabilityEdge firstInstability(const std::function<bool(double)>& isStable, const StabilityScan& scan) {
    constexpr double unit = std::numeric_limits<double>::epsilon();
    double low = 0;
    for (double z = 0.01; z < scan.end; z = z < scan.fineEnd ? z + scan.fine : z * scan.ratio + scan.coarse) {
        if (isStable(z)) {
            low = z;
            continue;
        }
        double high = z;
        for (int i = 0; i < 60 && low > 0 && high - low > 2 * unit * high; ++i) {
            const double middle = (low + high) / 2;
            (isStable(middle) ? low : high) = middle;
        }
        return {low, high};
    }
    return {low};
}

bool hasBoundedPowers(double halfTrace, double z) {
    constexpr double slack = 1e-9;
    return std::abs(halfTrace) <= 1 + slack * (1 + z * z);  // false where it is not a number
}

}  // namespace extremal
