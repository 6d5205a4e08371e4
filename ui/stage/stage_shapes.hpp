// SPDX-License-Identifier: GPL-3.0-or-later
/// What the parts of the stage's player know of shapes and of the view from a corner.
#pragma once

#include "engine/model/drawing.hpp"
#include "ui/stage/camera.hpp"

namespace extremal {

/// Where systems in space are seen from, at one pixel per unit.
Camera cornerView();
/// Drawn once, not once per scheme.
bool isScenery(const Shape& shape);
/// The shape elsewhere.
Shape movedBy(Shape shape, const Point& by);

}  // namespace extremal
