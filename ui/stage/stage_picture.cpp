// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_picture.hpp"

#include <algorithm>
#include <cmath>

#include "ui/stage/gl/surface.hpp"

namespace extremal {

QImage drawStage(const StageFrame& frame, const Camera& camera, QSizeF size, double pixelRatio) {
    // Creating a context and its shaders takes a tenth of a second; a context belongs to one thread.
    thread_local std::unique_ptr<StagePainter> painter;
    if (!painter) painter = std::make_unique<StagePainter>();
    // Up: where the ratio is not a whole number, a row that is covered in part would keep what was there
    // before.
    const auto pixels = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length * pixelRatio - 1e-6)));
    };
    return painter->draw(frame, camera, pixels(size.width()), pixels(size.height()), pixelRatio);
}

}  // namespace extremal
