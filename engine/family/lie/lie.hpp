// SPDX-License-Identifier: GPL-3.0-or-later
/// The integrator of the space lie-polynomial: LieStep on the system's group, or, symmetrised, half a step of
/// its adjoint and then half a step of it. Groups given as
/// data that are rotations of a body in other coordinates are stepped as such. That of the space
/// quaternion-polynomial: quaternion_step.hpp.
#pragma once

#include <memory>

#include "engine/action/table.hpp"
#include "engine/family/family.hpp"

namespace extremal {

/// Where the chart of a symmetric step has its base point.
inline constexpr double middleOfStep = 0.5;

/// The space lie-polynomial with its keys.
Settings lieSpace(int degree, bool isSymmetric = false, double base = 0);

std::unique_ptr<Integrator> makeLieIntegrator(const System& system, const Discretization& discretization,
                                              double step);

/// The table of the polynomials that xi, or the quaternion, is made of. Throws InvalidScene where space and
/// rule do not go together.
Table<double> lieTable(const Settings& space, const Settings& quadrature);

}  // namespace extremal
