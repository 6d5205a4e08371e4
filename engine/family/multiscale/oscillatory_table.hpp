// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of an oscillatory space (basis.hpp) and a rule, on steps with z = step * frequency.
///
/// A node of a Filon grid is a pair (c_i, phase_m): all M phases of a slow node share its time, and the
/// weights belong to these pairs, so that the action stays one weighted sum of the Lagrangian and the step
/// needs nothing but the table (action/table.hpp). A plain rule has phase = z c_i at its nodes, and must
/// resolve the oscillation.
///
/// Y_0..Y_{m-2} multiply functions with vanishing traces, orthonormal in phi phi + phi' phi' / (z . z + 1),
/// the last one is tau but for a part along these. On a grid that product is integrated over position and
/// phase as if they were independent, where the functions always are; with a plain rule along the curve,
/// where harmonics are nearly polynomials if z is small: functions whose square is below 1e-11 of the largest
/// are then left out.
#pragma once

#include <vector>

#include "engine/action/table.hpp"
#include "engine/quadrature/filon.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/family/multiscale/basis.hpp"

namespace extremal {

/// Throws InvalidScene where a plain rule does not resolve the square of an oscillation by z in a step.
void checkResolution(double z, const Rule<double>& rule);

/// Throws InvalidScene where the rule does not see all functions, or misses their kinetic energy. phases of
/// each frequency; the second 1 where there is one.
Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, const Phases<double>& z, FilonNodes nodes,
                                   int count, const Multiples& phases);
Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, const Phases<double>& z,
                                   const Rule<double>& rule);

}  // namespace extremal
