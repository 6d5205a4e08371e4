// SPDX-License-Identifier: GPL-3.0-or-later
/// The unit sphere on the stage.
#pragma once

#include "engine/model/drawing.hpp"

namespace extremal::spheres {

/// Circles of latitude and two meridians, as scenery.
void drawSphere(Drawing& drawing);

}  // namespace extremal::spheres
