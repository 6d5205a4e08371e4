// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the stage is drawn: something that makes an OpenGL context current and owns a framebuffer.
///
/// Three kinds: the window's widget (stage_canvas.cpp), OSMesa, the default without a display, and EGL
/// without a surface, which succeeds it where Mesa no longer has OSMesa (from 25.1 on). The libraries of the
/// last two are opened at run time, so that everything that draws no stage works without them.
#pragma once

#include <QImage>

#include <memory>
#include <string>

#include "ui/stage/camera.hpp"
#include "ui/stage/gl/gl_functions.hpp"
#include "ui/stage/gl/renderer.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

class Surface {
public:
    virtual ~Surface() = default;
    /// Makes the context current for a picture of this size in device pixels and returns its framebuffer.
    virtual unsigned begin(int width, int height) = 0;
    /// Valid after the first begin().
    virtual const GlFunctions& functions() const = 0;
};

/// Software OpenGL in main memory. Throws OpenGlUnavailable, naming the package, if libOSMesa is missing.
std::unique_ptr<Surface> makeOsmesaSurface();
/// OpenGL through EGL without display or window. Throws OpenGlUnavailable.
std::unique_ptr<Surface> makeEglSurface();
/// OSMesa; EGL if the environment variable EXTREMAL_SURFACE says "egl".
std::unique_ptr<Surface> makeHeadlessSurface();
/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 3.3": renderer and version as OpenGL names them.
std::string describeSurface(Surface& surface);

/// A renderer with its surface: makes pictures without a display. Use it from one thread.
class StagePainter {
public:
    explicit StagePainter(std::unique_ptr<Surface> surface = makeHeadlessSurface());
    ~StagePainter();

    /// `width` and `height` in device pixels; the image has this pixel ratio.
    QImage draw(const StageFrame& frame, const Camera& camera, int width, int height, double pixelRatio);

private:
    std::unique_ptr<Surface> surface_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace extremal
