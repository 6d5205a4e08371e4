// SPDX-License-Identifier: GPL-3.0-or-later
/// The System of a field over a rectangle: energy, momenta, charges, start, exact motion of linear fields,
/// samples and picture.
#pragma once

#include <memory>

#include "engine/model/plane_field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

System makePlaneFieldSystem(std::shared_ptr<const PlaneFieldProblem> problem);

}  // namespace extremal
