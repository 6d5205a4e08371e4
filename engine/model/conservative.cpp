// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/conservative.hpp"

#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

bool conservesEnergy(const System& system) {
    const Constraint* const constraint = system.parts.find<Constraint>();
    if (system.parts.find<Force>() || (constraint && constraint->isTimeDependent)) return false;
    if (isMechanical(system)) return !system.mechanics().isTimeDependent;
    if (isWave(system)) return !system.hamiltonian()->isTimeDependent();
    return true;
}

}  // namespace extremal
