// SPDX-License-Identifier: GPL-3.0-or-later
/// S6 of Blanes and Moan (2002): order 4, explicit for separable systems.
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry blanes_moan_s6() {
    return splittingBaseline(
        "blanes-moan-s6", "Blanes-Moan S6",
        "Optimised splitting of order 4 with six kicks: errors far below Yoshida's for the same work.",
        blanesMoanS6());
}

}  // namespace extremal::baselines
