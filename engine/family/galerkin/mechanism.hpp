// SPDX-License-Identifier: GPL-3.0-or-later
/// Galerkin schemes for mechanisms: one space and one rule for the Lagrangian, Lobatto nodes for constraints,
/// and forces by the rule of the Lagrangian or by one of their own.
///
///     "quadrature": {"otherwise": {...}, "forces": {"type": "radau", "nodes": 2, "end": "left"}}
///
/// The test function of p_0 vanishes at the right end, so that a rule without that node, and with the left
/// one, damps: with s nodes of Radau from the left the part of a force -c v is L-stable (Pade (s - 1, s)) and
/// of order 2s - 1; Gauss nodes ring from c h = 10 on, Radau from the right grows. Keys of rules besides
/// `otherwise`: `forces`; `constraints`, which may say lobatto, what they are in any case; `rolling`, whose
/// multipliers are at the nodes of lobatto or gauss (MechanismRules::isRollingAtGauss).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"

namespace extremal::galerkin {

/// What is wrong with the law of impacts that is asked for; nothing: it is not wrong.
std::optional<Properties> impactProblem(const Discretization& discretization, const System& system);
/// Why a discretization is refused for a system with more than a Lagrangian; empty: it is not.
std::string mechanismProblem(const Discretization& discretization, const System& system);
/// `describe`: of a discretization with one space and one rule, for a Lagrangian.
Properties describeMechanism(const Discretization& discretization, const System& system,
                             Properties (*describe)(const Discretization&));
std::unique_ptr<Integrator> mechanismStep(const System& system, const Discretization& discretization,
                                          double step);
/// Damping that is stiff for the rule of the forces, and rules that amplify it.
void checkMechanism(const SchemeCase& scheme, Findings& findings);

}  // namespace extremal::galerkin
