// SPDX-License-Identifier: GPL-3.0-or-later
/// SRKN 14a of Blanes and Moan (2002): order 6, for L = 1/2 sum m v^2 - V(t, q).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry srkn_14a() {
    return splittingBaseline("srkn-14a", "Blanes-Moan SRKN 14a",
                             "Symplectic Runge-Kutta-Nyström of order 6 with fourteen kicks, drift first.",
                             srkn14a());
}

}  // namespace extremal::baselines
