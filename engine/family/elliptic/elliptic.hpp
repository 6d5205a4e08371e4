// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete solution of the elliptic problem as a march along x: nothing is integrated, the nodal values
/// are found at once and given one by one, with the curve of the elements between them.
#pragma once

#include <memory>

#include "engine/family/family.hpp"

namespace extremal {

/// Throws InvalidScene (pointer relative to the scheme) where the system is another one, or the step is not a
/// whole part of 1.
std::unique_ptr<Integrator> makeEllipticIntegrator(const System& system, const Discretization& discretization,
                                                   double step);

}  // namespace extremal
