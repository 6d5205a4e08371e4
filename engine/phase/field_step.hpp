// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a cell for x' = f(x), as that of the Hamiltonian lambda . f(x) with lambda = 0: of the order
/// of the cell, collocation where it has as many nodes as degrees, and not symplectic.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/first_order/first_order.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// `table` does not change with the step.
std::unique_ptr<Integrator> makeFieldStep(const FirstOrder& of, const SharedCell& cell, double step,
                                          const SolverPolicy& policy);

}  // namespace extremal
