// SPDX-License-Identifier: GPL-3.0-or-later
/// Slow models of the spring pendulum. Averaged over the oscillation of the spring, whose adiabatic invariant
/// stays; or the spring taken for a rod, which is wrong by a part 1/k.
#include "engine/baseline/reduced.hpp"

namespace extremal::baselines {

std::vector<BaselineEntry> slow_models() {
    return {
        reducedBaseline("averaged", "averaged pendulum",
                        "The pendulum averaged over the oscillation of its spring, whose adiabatic "
                        "invariant stays: the slow swing alone."),
        reducedBaseline("rigid-pendulum", "rigid pendulum",
                        "The spring taken for a rod: the slow swing alone, wrong by a part 1/k."),
    };
}

}  // namespace extremal::baselines
