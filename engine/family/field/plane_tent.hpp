// SPDX-License-Identifier: GPL-3.0-or-later
/// Tensor elements on a periodic rectangle: polynomials of degree r along both axes and of degree s in time
/// on each cell, with one rule along both axes and one in time. Internal to engine/family/field.
///
/// With the trapezoidal rule everywhere and degree 1 the step is leapfrog with five points. All others are
/// solved in the modes of the mesh (modal_step.hpp). A step is stable up to
///
///     h^2 (c^2 (lambda_x + lambda_y) + W'') <= z^2,   lambda: the largest eigenvalue of the elements along
/// an axis, z: the limit of the rule in time (dispersion.hpp).
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/family/discretization.hpp"
#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Why the space cannot be on the rectangle; nothing where it can.
std::optional<Problem> refusalOnPlane(const Discretization& d, const PlaneFieldProblem& problem);

/// The same in words, of a system that may be something else: SchemeCondition.
std::string mismatchOnPlane(const Discretization& d, const System& system);

/// What the space promises there. Values are at equidistant nodes, inside elements of degree 3 not where they
/// are best: of order 4. Meshes stay as they are when steps are refined, so that orders are those in time.
std::optional<Properties> describeOnPlane(const Discretization& d, const System& system);

/// The longest step that is stable for so many steps, with the largest W'' between the extremes of u;
/// infinite where every step is.
double longestPlaneStep(const Discretization& d, const PlaneFieldProblem& problem, const double* u,
                        double steps = std::numeric_limits<double>::infinity());

void checkPlaneTent(const SchemeCase& scheme, Findings& findings);

std::unique_ptr<Integrator> makePlaneTent(const System& system, const Discretization& d, double step);

}  // namespace extremal
