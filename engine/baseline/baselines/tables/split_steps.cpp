// SPDX-License-Identifier: GPL-3.0-or-later
/// Split-step methods of wave functions.
#include "engine/baseline/splitting_baseline.hpp"

namespace extremal::baselines {

std::vector<BaselineEntry> split_steps() {
    return {
        waveSplittingBaseline("strang", "Strang splitting",
                              "Split-step of order 2: half a kick, a drift, half a kick; one kick per step.",
                              strang()),
        waveSplittingBaseline(
            "suzuki-4", "Suzuki 4",
            "Split-step of order 4: five Strang steps, one of them backwards; five kicks per step.",
            suzuki4()),
    };
}

}  // namespace extremal::baselines
