// SPDX-License-Identifier: GPL-3.0-or-later
/// Walls on the stage: where the gap of a wall to a body in a plane is 0, as far as it can be seen from where
/// the body is when it is first drawn.
#pragma once

#include <utility>
#include <vector>

#include "engine/model/parts/wall.hpp"
#include "engine/model/typed/typed_picture.hpp"

namespace extremal::typed {

/// The picture with the walls of bodies behind it. `planes`: the coordinates x and y of each body. Walls
/// between bodies, and those of no body in a plane, are not drawn.
Picture withWalls(Picture picture, const Wall& wall, const std::vector<std::pair<int, int>>& planes,
                  int dimension);

}  // namespace extremal::typed
