// SPDX-License-Identifier: GPL-3.0-or-later
/// The pendulum averaged over the oscillation of its spring, whose adiabatic invariant stays: the slow swing
/// alone.
#include "engine/baseline/reduced.hpp"

namespace extremal::baselines {

BaselineEntry averaged() {
    return reducedBaseline("averaged", "averaged pendulum",
                           "The pendulum averaged over the oscillation of its spring, whose adiabatic "
                           "invariant stays: the slow swing alone.");
}

}  // namespace extremal::baselines
