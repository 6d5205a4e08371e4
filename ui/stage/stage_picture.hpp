// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of the stage without a display, with the words on it or without.
#pragma once

#include <QImage>
#include <QSizeF>

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

/// Draws with the thread's own painter, which is made at the first call and kept. `size` in logical pixels.
/// Throws OpenGlUnavailable (a std::runtime_error) with the package to install.
QImage drawStage(const StageFrame& frame, const Camera& camera, QSizeF size, double pixelRatio);

}  // namespace extremal
