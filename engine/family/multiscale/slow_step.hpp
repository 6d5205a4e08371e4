// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a slow model, as one of the system.
///
/// The state that goes on from step to step is y of the model (model/slow/slow_models.hpp), in the memory;
/// the state of the system is made of it at each node. A run that begins projects the state of the system
/// once.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/slow/slow_models.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// `cell` of a table that does not change with the step.
std::unique_ptr<Integrator> slowStep(const SlowModel& model, const SharedCell& cell, double step,
                                     const SolverPolicy& policy);

}  // namespace extremal
