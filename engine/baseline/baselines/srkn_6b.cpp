// SPDX-License-Identifier: GPL-3.0-or-later
/// SRKN 6b of Blanes and Moan (2002): order 4, for L = 1/2 sum m v^2 - V(t, q).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry srkn_6b() {
    return splittingBaseline("srkn-6b", "Blanes-Moan SRKN 6b",
                             "Symplectic Runge-Kutta-Nyström of order 4 with six kicks.", srkn6b());
}

}  // namespace extremal::baselines
