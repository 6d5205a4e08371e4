// SPDX-License-Identifier: GPL-3.0-or-later
/// Leapfrog for a typed density L = sum m u_t^2/2 - V(u, grad u, x, [y], t): the elements of the density
/// (DensityProblem::places) and lines in time, with the trapezoidal rule in each direction,
///
///     M v' = M v - h/2 dU(u, t),   u+ = u + h v',   M v+ = M v' - h/2 dU(u+, t + h),
///     U = sum over the cells and their corners of dx [dy]/2^d V.
/// Explicit, of order 2, multisymplectic. Of components at nodes and a usual V it is plane_leapfrog.hpp; of
/// the potential of electrodynamics on edges it is Yee's scheme, which keeps div E at each node.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/density/problem.hpp"

namespace extremal {

/// `problem.density.implicitBecause()` must be empty.
std::unique_ptr<Integrator> makeDensityLeapfrog(std::shared_ptr<const DensityProblem> problem, double step);

/// The longest stable step about (u, t): 2 over the root of the largest eigenvalue of the elements, d2U by M
/// of one cell, which is not below that of all cells and is the same where all are. Infinite where no
/// eigenvalue is positive; NaN where masses have unlike signs.
double densityLeapfrogLimit(const std::shared_ptr<const DensityProblem>& problem, double t, const double* u);

}  // namespace extremal
