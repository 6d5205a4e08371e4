// SPDX-License-Identifier: GPL-3.0-or-later
/// The KKT matrix of one slab of a field, nothing eliminated: the degrees of freedom of every cell for
/// itself, the continuity between neighbours and to the values at a Dirichlet boundary, and the values at
/// both ends of the slab, each with its multiplier,
///
///     A = sum_e S_e(z_e) + lambda . C z + p . (s-(z) - u) - p' . (s+(z) - u').
/// Unknowns in the order of space, between those of the ends in time: p, lambda_0, z_0, lambda_1, z_1, ..,
/// p', where lambda_e ties cell e to the cells before it (and the last of a circle to the first as well). The
/// momenta and the multipliers are the blocks of `isMultiplier`: index 0 is p, e + 1 is lambda_e, and N + 1
/// is p'. Source: Leok 2004, sec. 2.1.
#pragma once

#include <memory>

#include "engine/family/field/cell.hpp"
#include "engine/family/step_equations.hpp"

namespace extremal {

/// A stretch of a mesh with the same boundary, elements [from, from + count): a circle is closed again.
std::shared_ptr<const FieldProblem> stretchOf(const FieldProblem& problem, int from, int count);

/// At the levels U_0 .. U_s of the slab, level after level, at all nodes of the problem.
StepMatrix slabMatrix(const FieldProblem& problem, int timeDegree, const Rule<double>& space,
                      const Rule<double>& time, double step, const std::vector<double>& levels);

}  // namespace extremal
