// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/flow_step.hpp"

#include <vector>

#include "engine/integrator/condensed.hpp"
#include "engine/phase/phase_step.hpp"

namespace extremal {

std::unique_ptr<Integrator> makeFlowStep(const PhaseMechanics& mechanics, const SharedCell& cell, double step,
                                         const SolverPolicy& policy) {
    if (!mechanics.isSeparable()) return makePhaseStep(mechanics, cell, step, policy);
    return makeCondensed(
        flowOf(mechanics), [cell](double) { return std::vector{cell->table}; }, step, policy);
}

}  // namespace extremal
