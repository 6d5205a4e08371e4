// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/stability.hpp"

#include <cmath>
#include <limits>

namespace extremal {

double firstInstability(const std::function<double(double)>& halfTrace, double resolution) {
    constexpr double slack = 1e-9, end = 60;
    auto isUnstable = [&](double z) { return !(std::abs(halfTrace(z)) <= 1 + slack * (1 + z * z)); };
    double low = 0;
    for (double z = 0.01; z < end; z += z < 12 ? resolution : 5 * resolution) {
        if (!isUnstable(z)) {
            low = z;
            continue;
        }
        double high = z;
        if (low == 0) return 0;
        for (int i = 0; i < 50; ++i) {
            const double middle = (low + high) / 2;
            (isUnstable(middle) ? high : low) = middle;
        }
        return low;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace extremal
