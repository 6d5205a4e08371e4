// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in space on the stage: bodies as solids, arms to their joints, axes of joints, points, rods,
/// springs and dampers, and the ground that joints and fixed points have.
#pragma once

#include "engine/model/cartesian/elements_picture.hpp"
#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

cartesian::MechanismPicture pictureOf(Assembly assembly);

}  // namespace extremal::spatial
