// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that end where a typed Lagrangian has a kink or a jump, and go on with the formula's other branch.
///
/// In the cell that the motion is in (model/typed/branches.hpp) the Lagrangian is smooth. A step is tried
/// with its branches held fixed; if the dense output leaves the cell, the step is taken again, with a length
/// at which the argument of the switch is on the limit: by Newton's method in a bracket, whose every iterate
/// is a whole step, to the round-off of t. There the branch is exchanged. A scheme so has its order, its
/// error control and its dense output on motions that are smooth in pieces; jumps of L itself have no kick,
/// as its derivatives are those of the branches.
///
/// A limit that is touched and not passed is no reason to stop. Where the argument of a switch is on a limit
/// at the start, the direction of the motion decides, by its first and then its second derivative; at rest on
/// the limit the branch is that of the formula itself. The formula is stepped as it is where a motion is
/// pressed against a limit from both sides (sliding), passes more than `mostSwitches` limits in a step, more
/// than `mostShortPieces` in a row within 1e-9 of it, or comes to more than `mostSidesMade` branches
/// (floor(1e6 t)), and where it cannot be continued beyond a limit (sqrt(abs(x))). An error control whose
/// steps then lead nowhere ends with the outcome stepBudget.
///
/// The tangent map has the jump of the variation at a switch whose place depends on the state:
///     w+ = w- + (f+ - f-) (ds/dx . w-) / (ds/dt)-
#pragma once

#include <functional>
#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

using MakeIntegrator = std::function<std::unique_ptr<Integrator>(const System&)>;

/// What `make` makes of the system, with steps that end at its switches; without any change where the system
/// has no switches or the times of nodes are unknowns. On a fixed grid a step consists of as many pieces as
/// it needs and ends at its node; on a landing one each piece is a step.
std::unique_ptr<Integrator> landingOnSwitches(const System& system, const MakeIntegrator& make);

}  // namespace extremal
