// SPDX-License-Identifier: GPL-3.0-or-later
/// One impact on a wall, as a step reports it, and what is equal on both sides of it.
#pragma once

namespace extremal {

/// Of impacts without a loss: the energy H of the state, or the discrete energies of the two parts of the
/// step.
enum class ImpactLaw { energy, variational };

struct Impact {
    int wall = 0;
    double t = 0;
    double impulse = 0;                      ///< J of p+ = p- + J gap_q + (reactions of constraints)
    double speedBefore = 0, speedAfter = 0;  ///< d gap / dt on both sides: negative, then not
    double energyLoss = 0;                   ///< H- less H+
};

}  // namespace extremal
