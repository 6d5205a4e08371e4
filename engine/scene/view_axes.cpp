#include "engine/scene/view_axes.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

bool isDrawable(double low, double high, bool isLog) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) return false;
    if (isLog) return low > -300 && high < 300 && high - low > 1e-6;
    const double largest = std::max(std::abs(low), std::abs(high));
    return high - low > 1e-11 * largest && largest < 1e290 && high - low > 1e-290;
}

}  // namespace extremal
