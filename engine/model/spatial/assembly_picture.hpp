// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in space on the stage: bodies as solids, arms to their joints, axes of joints, points, rods,
/// springs and dampers, and the ground that joints and fixed points have.
#pragma once

#include <cstddef>
#include <functional>

#include "engine/model/drawing.hpp"
#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

struct AssemblyPicture {
    /// Of states (q, p) in the coordinates of the written Lagrangian.
    std::function<void(const double* x, Drawing& drawing)> draw;
    std::size_t firstRod = 0;  ///< place of the first rod among the shapes; the others follow
};
AssemblyPicture pictureOf(Assembly assembly);

}  // namespace extremal::spatial
