// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a cell (phase/phase_cell.hpp) for Hamilton's equations.
///
/// Fixed point: K and F at all nodes from the q and p that they make, contracting with h |H''|. Where it is
/// slow, Newton's method on (alpha, beta),
///     alpha - h ofRates H_p = 0,    beta - e_1 p_0 - h ofForces F = 0,
/// whose matrix needs H'' and no inverse of H_pp; where that fails from all starting values the solution is
/// followed from a short step (solve/step_continuation.hpp). Nothing is allocated but there, and when that
/// begins. What q and p lose to rounding is carried on.
///
/// Dense output: q on the curve of the space; p_0 - int H_q, the integral of the polynomial through the
/// nodes, which is continuous from step to step, where the p of the cell is not.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// `cell` of a table that does not change with the step. Where H = p^2/(2m) + V(t, q) the cell is that of the
/// Lagrangian (integrator/condensed.hpp), whose fixed point contracts with h^2.
std::unique_ptr<Integrator> makePhaseStep(const PhaseMechanics& mechanics, const SharedCell& cell,
                                          double step, const SolverPolicy& policy);

}  // namespace extremal
