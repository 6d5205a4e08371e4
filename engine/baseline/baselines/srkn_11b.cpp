// SPDX-License-Identifier: GPL-3.0-or-later
/// SRKN 11b of Blanes and Moan (2002): order 6, for L = 1/2 sum m v^2 - V(t, q).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry srkn_11b() {
    return splittingBaseline("srkn-11b", "Blanes-Moan SRKN 11b",
                             "Symplectic Runge-Kutta-Nyström of order 6 with eleven kicks.", srkn11b());
}

}  // namespace extremal::baselines
