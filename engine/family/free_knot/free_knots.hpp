// SPDX-License-Identifier: GPL-3.0-or-later
/// The profile with the least energy as a march along x: nothing is integrated, knots and values are found at
/// once (knots.hpp) and given one by one, with the straight lines between them.
///
/// State: x = (u, C, E_e, E): the value at a knot; of the element that ends there the derivative of its
/// energy by its right end, C = dE_e/dx_R, and its energy; the energy of the profile. Where knots are
/// stationary, and nothing depends on the place, C is the same for all elements.
#pragma once

#include <memory>

#include "engine/family/free_knot/knots.hpp"
#include "engine/integrator/integrator.hpp"

namespace extremal {

std::unique_ptr<Integrator> makeFreeKnots(std::shared_ptr<const KnotProfile> profile);

/// The state at the left end.
State knotStart(const KnotProfile& profile);

}  // namespace extremal
