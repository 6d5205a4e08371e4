// SPDX-License-Identifier: GPL-3.0-or-later
/// Galerkin schemes with a rule for each term of the Lagrangian, or a space for each coordinate.
///
/// The terms L_r of L are grouped by their rules, and S = h sum_r sum_i b_i^r L_r(c_i^r) is still one
/// discrete action: the step is symplectic, keeps the momenta of symmetries that every L_r has, and is
/// symmetric where all rules are. With A the rule of the velocities, phi_a the interior functions of the
/// coordinates in L_r,
///     kappa = min( kappa of A, 1 + min over r, k of { k : (rule_r - A)(tau^k phi_a) != 0 } ),
///     order = min( 2 degree, degrees of the rules + 1, 2 kappa );
/// for polynomials of degree s, A = Gauss(s) and a potential under Gauss(u): min(2s, 2u, 2 max(1, 2u - s +
/// 1)). A term with velocities needs a rule that integrates them.
#pragma once

#include <string>
#include <vector>

#include "engine/family/family.hpp"
#include "engine/action/table.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal::galerkin {

/// Whether a discretization is one of several rules or spaces.
bool isSplit(const Discretization& discretization);

/// What a scene's keys mean for a system.
struct Split {
    std::vector<Settings> spaces;               ///< one for all coordinates, or one for each
    std::vector<LagrangianTerm<double>> parts;  ///< one for each rule, with all its terms
    std::vector<Settings> rules;                ///< of the parts
    std::vector<std::vector<bool>> sees;        ///< (r, k): part r depends on coordinate k or its velocity
    std::vector<std::vector<bool>> moves;       ///< (r, k): on its velocity
    std::size_t kineticPart(std::size_t coordinate) const;
};
/// Throws InvalidScene: the system has no such term or coordinate.
Split splitOf(const System& system, const Discretization& discretization);

/// One for all coordinates or one for each; their nodes say which part they are for where there are several.
std::vector<Table<double>> tablesOf(const Split& split, double step);

/// Claims, and why it is refused.
Properties describeSplit(const Discretization& discretization, const System& system);
/// The same whatever the system: terms without a rule of their own are taken to have the velocities, unless
/// "kinetic" has one.
Properties describeSplit(const Discretization& discretization);

/// Bands of instability at the frequencies of the parts at the start, and symmetries that a part alone does
/// not have.
void checkSplit(const SchemeCase& scheme, Findings& findings);

}  // namespace extremal::galerkin
