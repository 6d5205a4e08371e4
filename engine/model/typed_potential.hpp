// SPDX-License-Identifier: GPL-3.0-or-later
/// A potential U(x, R) as a user types it, for rigid bodies: expressions in x, y, z and R11..R33,
/// differentiated symbolically.
///
/// The position is that of the centre of mass in space, Rij the component along space axis i of body axis j.
/// Further names are mass, I1, I2, I3 and the parameters. On SO(3) there is no position. Errors: InvalidScene
/// with the pointer "/potential" and a caret under the place.
#pragma once

#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/body/body.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The keys "potential" and "parameters" of such a model.
std::vector<FieldInfo> typedPotentialFields(bool movesInSpace);

/// Gives the body, whose dimension and inertia are set, the potential of these keys; one that is constant
/// leaves it free. Returns the momenta that are kept: linear momentum along the coordinates U does not depend
/// on, and angular momentum about the origin along the axes it is symmetric about (found by probing: U may
/// have no term that breaks the symmetry at any of the probes).
std::vector<MomentumMap> setTypedPotential(BodyMechanics<double>& body, const Settings& settings);

}  // namespace extremal
