// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said of symmetries that a scene does not have.
#pragma once

#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Whether symmetries depend on the numbers of a scene, so that to ask for their momenta where there are none
/// is a warning and not an error.
inline bool mayHaveSymmetries(const System& system) {
    return system.hasCoordinates() || system.isMovedOnlyBy<PhaseMechanics>();
}

}  // namespace extremal
