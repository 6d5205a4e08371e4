// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/conservative.hpp"

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

bool conservesEnergy(const System& system) {
    if (isMechanical(system)) return !system.mechanics().isTimeDependent;
    if (isWave(system)) return !system.hamiltonian()->isTimeDependent();
    return true;
}

}  // namespace extremal
