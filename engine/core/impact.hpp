// SPDX-License-Identifier: GPL-3.0-or-later
/// One impact on a wall, as a step reports it.
#pragma once

namespace extremal {

struct Impact {
    int wall = 0;
    double t = 0;
    double impulse = 0;                      ///< J of p+ = p- + J gap_q + (reactions of constraints)
    double speedBefore = 0, speedAfter = 0;  ///< d gap / dt on both sides: negative, then not
    double energyLoss = 0;                   ///< H- less H+
};

}  // namespace extremal
