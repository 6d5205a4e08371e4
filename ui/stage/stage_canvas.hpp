// SPDX-License-Identifier: GPL-3.0-or-later
/// The two kinds of ground a StageWidget can paint on: an OpenGL widget, or a plain one that shows pictures
/// made without a display.
#pragma once

#include <functional>
#include <memory>

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

class QString;
class QWidget;

namespace extremal {

/// What a canvas asks its owner for when it is painted.
struct CanvasSource {
    std::function<const StageFrame&()> frame;
    std::function<Camera()> camera;
    /// Called when nothing can be drawn; the text says why and what to install.
    std::function<void(const QString&)> fail;
};

/// True if the platform gives a hardware OpenGL 3.3 context. Software OpenGL on a display is refused:
/// composing the whole window with it is slower than showing pictures made by OSMesa. The environment can
/// insist: EXTREMAL_STAGE=opengl takes software OpenGL as well, EXTREMAL_STAGE=picture takes none (for faulty
/// drivers). Asked once; GUI thread.
bool hasGraphicsCard();
/// Its name; empty: there is none.
QString graphicsCard();

/// A child widget of `parent` that paints from `source`, without words: grabbing an OpenGL widget loses what
/// a QPainter adds to it. Call update() on it for a new frame.
QWidget* makeCanvas(QWidget* parent, CanvasSource source, bool usesGraphicsCard);

}  // namespace extremal
