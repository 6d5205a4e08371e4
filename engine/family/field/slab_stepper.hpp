// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a field by the one equation of the framework, with nothing eliminated:
///
///     dS/dz + C^T lambda + (Ds-)^T p - (Ds+)^T p' = 0,   C z = 0,   s-(z) = u,
/// S the sum of the actions of all cells of a slab, z the degrees of freedom of every cell for itself, C the
/// continuity between neighbours at all levels, lambda its multipliers, p and p' the momenta at both ends of
/// the slab. At a Dirichlet boundary C holds the values at all levels. Solved by Newton's method with a
/// sparse LU of the whole KKT system. It is slow, and it is what every fast way is tested against.
#pragma once

#include <memory>

#include "engine/family/field/cell.hpp"
#include "engine/integrator/integrator.hpp"

namespace extremal {

std::unique_ptr<Integrator> makeSlabStepper(std::shared_ptr<const FieldProblem> problem, int timeDegree,
                                            const Rule<double>& space, const Rule<double>& time, double step);

}  // namespace extremal
