// SPDX-License-Identifier: GPL-3.0-or-later
/// The condensed step of a discretization with tables (integrator/galerkin_step.hpp) as an Integrator, for
/// the families that have them.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/settings.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What a scene's "solver" means for a system. Throws InvalidScene (pointer /solver/method).
SolverPolicy solverPolicy(const Settings& solver, const System& system);

/// One table for all coordinates or one for each, for a step size.
using TablesOfStep = std::function<std::vector<Table<double>>(double step)>;
/// `parts`: what the nodes of tables with parts are for. `entries`: of the Lagrangian, where they are known.
std::unique_ptr<Integrator> makeCondensed(const Mechanics<double>& mechanics, TablesOfStep tables,
                                          double step, const SolverPolicy& policy,
                                          std::vector<LagrangianTerm<double>> parts = {},
                                          const LagrangianEntries* entries = nullptr);

}  // namespace extremal
