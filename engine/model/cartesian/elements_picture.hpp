// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism on the stage: rods and bodies, springs as zigzags, dampers as a piston in a pot, motors as
/// arrows around their axis, fixed points on their supports, lines of sliders, and walls hatched on the side
/// where nothing is.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/model/cartesian/elements.hpp"
#include "engine/model/drawing.hpp"

namespace extremal::cartesian {

struct MechanismPicture {
    /// Of states (q, p) in the coordinates of the written Lagrangian.
    std::function<void(const double* x, Drawing& drawing)> draw;
    std::size_t firstRod = 0;  ///< place of the first rod among the shapes; the others follow
};
MechanismPicture pictureOf(Elements elements);

}  // namespace extremal::cartesian
