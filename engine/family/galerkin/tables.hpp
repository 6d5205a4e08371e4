// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of Galerkin schemes: a space and a rule as a scene names them, on cells that need not be equal, and
/// rules that are chosen for the space.
#pragma once

#include <memory>

#include "engine/action/table.hpp"
#include "engine/core/settings.hpp"

namespace extremal {
struct Tableau;
class OscillatorStep;
}  // namespace extremal

namespace extremal::galerkin {

/// Number of cells of a space in one step.
int cellsIn(const Settings& space);

/// The rule with its default keys. "auto" stays for typed functions, whose rule follows from them.
Settings completedRule(const Settings& space, const Settings& quadrature);

/// The rule in its panels: equal ones, or, where their number is a multiple of that of unequal cells, equal
/// parts of each cell. "auto" is Gauss's with the fewest nodes per cell that integrate phi_a' phi_b' and
/// (phi_a phi_b)' to 4e-14. Throws InvalidScene where there is none with at most 96.
/// T: double or quadruple precision.
template <class T>
Rule<T> ruleOn(const Space<double>& space, const Settings& quadrature);

/// Keys complete, and with the step where the space depends on it.
Table<double> makeTable(const Settings& space, const Settings& quadrature);

/// The step as a Runge-Kutta method, from the table in quadruple precision. Throws InvalidScene where it is
/// none.
std::shared_ptr<const Tableau> tableauOf(const Settings& space, const Settings& quadrature);

/// The step on the harmonic oscillator, from the table in quadruple precision. Throws InvalidScene where the
/// space cannot be evaluated there.
OscillatorStep oscillatorOf(const Settings& space, const Settings& quadrature);

}  // namespace extremal::galerkin
