// SPDX-License-Identifier: GPL-3.0-or-later
/// S10 of Blanes and Moan (2002): order 6, explicit for separable systems.
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry blanes_moan_s10() {
    return splittingBaseline("blanes-moan-s10", "Blanes-Moan S10",
                             "Optimised splitting of order 6 with ten kicks, explicit for separable systems.",
                             blanesMoanS10());
}

}  // namespace extremal::baselines
