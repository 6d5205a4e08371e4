// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a field with any Lagrangian density: hat functions on rectangles of space and time.
///
///     S(u_0, u_1) = sum over the cells of a slab and the nodes of a rule of w L(u, u_t, u_x, [u_y], x, [y],
///     t), p_0 + dS/du_0 = 0,   p_1 = dS/du_1,   p = dL_h/du_t(u, u_t, t),
/// L_h the same sum over space alone. The first equation gives u_1, by Newton's method with a banded LU of
/// d2S/du_0 du_1, which is not symmetric where the density has terms such as u_t u_x; the last one u_t.
/// Factors are kept while they contract. The slab is implicit, multisymplectic, and of order 2; with the
/// midpoint rule in time it is stable at every step for linear fields.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

/// The nodes of a rectangle are at most these along each side: the band of the matrix is as wide as two rows.
inline constexpr int mostCellsAlong = 64;

/// What a step would have to hold; InvalidScene with the pointer where it is too much.
void requireAffordable(const DensityProblem& problem, const char* pointer);

std::unique_ptr<Integrator> makeImplicitCells(std::shared_ptr<const DensityProblem> problem,
                                              const Rule<double>& space, const Rule<double>& time,
                                              double step);

}  // namespace extremal
