// SPDX-License-Identifier: GPL-3.0-or-later
/// Galerkin schemes for Hamiltonians and one-forms: q in the space, p in the space of its slopes
/// (phase/phase_cell.hpp), by one space and one rule. Of a one-form p = P(q, y) (phase/one_form_step.hpp).
///
/// The step is that of a Lagrangian cell where the rule has as many nodes as the space has degrees, and where
/// H is separable with constant masses; else it is another one of the same order.
#pragma once

#include <memory>
#include <string>

#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal::galerkin {

/// Whether a Hamiltonian or a one-form moves the system.
bool isPhase(const System& system);
/// Why a discretization is refused for one of these; empty: it is not, or the system has none.
std::string phaseProblem(const Discretization& discretization, const System& system);
/// `describe`: of a discretization with one space and one rule, for a Lagrangian.
Properties describePhase(const Discretization& discretization, const System& system,
                         Properties (*describe)(const Discretization&));
std::unique_ptr<Integrator> phaseStep(const System& system, const Discretization& discretization,
                                      double step);
/// The discrete action of a Hamiltonian, and its stationarity.
WrittenAction writtenPhase(const System& system);
/// Rules that see a degree less than the space has.
void checkPhase(const SchemeCase& scheme, Findings& findings);

}  // namespace extremal::galerkin
