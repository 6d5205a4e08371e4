// SPDX-License-Identifier: GPL-3.0-or-later
/// The System of a field over a rectangle: energy, momentum, start, exact motion of linear fields, samples
/// and picture.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/plane_field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

System makePlaneFieldSystem(std::shared_ptr<const PlaneFieldProblem> problem);

/// The keys of /initial: `u` and `u_t`, expressions in x, y and in r, phi about the origin, or values at the
/// nodes.
std::vector<FieldInfo> planeFieldStartFields();

}  // namespace extremal
