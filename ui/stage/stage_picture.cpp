// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_picture.hpp"

#include <QThreadStorage>

#include <algorithm>
#include <cmath>

#include "ui/stage/gl/surface.hpp"

namespace extremal {

QImage drawStage(const StageFrame& frame, const Camera& camera, QSizeF size, double pixelRatio) {
    // Creating a context and its shaders takes a tenth of a second; a context belongs to one thread. Qt waits
    // for what its own storage holds when it waits for a thread; thread_local objects of a thread of a pool
    // are destroyed after that, perhaps while the program already exits and OpenGL is no longer there.
    static QThreadStorage<StagePainter*> painters;
    if (!painters.hasLocalData()) painters.setLocalData(new StagePainter);
    StagePainter* painter = painters.localData();
    // Up: where the ratio is not a whole number, a row that is covered in part would keep what was there
    // before.
    const auto pixels = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length * pixelRatio - 1e-6)));
    };
    return painter->draw(frame, camera, pixels(size.width()), pixels(size.height()), pixelRatio);
}

}  // namespace extremal
