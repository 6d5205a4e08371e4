// SPDX-License-Identifier: GPL-3.0-or-later
/// Split-step of order 2: half a kick, a drift, half a kick; one kick per step.
#include "engine/baseline/wave_splitting.hpp"

namespace extremal::baselines {

BaselineEntry strang() {
    return waveSplittingBaseline(
        "strang", "Strang splitting",
        "Split-step of order 2: half a kick, a drift, half a kick; one kick per step.", extremal::strang());
}

}  // namespace extremal::baselines
