// SPDX-License-Identifier: GPL-3.0-or-later
/// The space without the oscillation: curves of a slow model (model/slow/slow_models.hpp) in place of the
/// system, in steps that are long for the oscillation and know nothing of it.
///
/// q and p of the model are polynomials, and the discrete action is that of its Hamiltonian K,
///     S(q_0, q_1) = ext h sum_i b_i [P_i . V_i - K(Q_i, P_i)]                  (phase/phase_cell.hpp),
/// so that the step is symplectic in (q, p) and of order 2s there with degree s and Gauss(s). Where the model
/// has the action of the oscillation among its momenta, that is constant to the last bit. The state of the
/// system at a node is the one that the model says. What the model leaves out of the system stays its error,
/// however short the steps: no order is claimed for the system.
///
/// Keys of the space: `model`, one of the ids of the system's slow models; `degree`.
#pragma once

#include <memory>
#include <string>

#include "engine/family/scheme.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

SpaceEntry slowSpace();
bool isSlow(const Settings& space);
Properties describeSlow(const Settings& space, const Settings& quadrature);
Settings completeSlowRule(const Settings& space, const Settings& quadrature);
/// Why it cannot be used on a system; empty if it can.
std::string slowMismatch(const Settings& space, const System& system);
/// What stands in place of the system: "rod".
std::string slowTitle(const Settings& space, const System& system);
WrittenAction writtenSlow(const Settings& space);
/// A model that is no good for the motion of a scene.
void checkSlow(const SchemeCase& scheme, Findings& findings);

std::unique_ptr<Integrator> makeSlowStep(const System& system, const Discretization& discretization,
                                         double step, const SolverPolicy& policy);

/// The named schemes: a slow model under Gauss's rule.
Discretization slowScheme(const char* model, int degree);

}  // namespace extremal
