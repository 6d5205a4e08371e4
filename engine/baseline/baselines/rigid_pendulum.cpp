// SPDX-License-Identifier: GPL-3.0-or-later
/// The spring taken for a rod: the slow swing alone, wrong by a part 1/k.
#include "engine/baseline/reduced.hpp"

namespace extremal::baselines {

BaselineEntry rigid_pendulum() {
    return reducedBaseline("rigid-pendulum", "rigid pendulum",
                           "The spring taken for a rod: the slow swing alone, wrong by a part 1/k.");
}

}  // namespace extremal::baselines
