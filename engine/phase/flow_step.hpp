// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a discretization for Hamilton's equations, whichever is the cheaper cell.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// Where H = p^2/(2m) + V(t, q), the cell of the Lagrangian, with p = m v at the nodes
/// (integrator/condensed.hpp); else that of phase/phase_step.hpp. `table` must not change with the step.
std::unique_ptr<Integrator> makeFlowStep(const PhaseMechanics& mechanics, const SharedCell& cell, double step,
                                         const SolverPolicy& policy);

}  // namespace extremal
