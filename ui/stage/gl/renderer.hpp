// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws a StageFrame with OpenGL 3.3 core: the same pixels on screen and off screen.
///
/// Strokes are quads whose edges are smoothed in the fragment shader, so no multisampled framebuffer is
/// needed and every surface gives the same picture. A batch of united strokes is first gathered in a layer of
/// its own, where the largest coverage wins (premultiplied colours, blend equation MAX), and then laid over
/// the picture. The context must be current in every call, the destructor included.
#pragma once

#include <memory>

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

struct GlFunctions;

struct RenderTarget {
    unsigned framebuffer = 0;   ///< a window's default framebuffer need not be 0
    int width = 0, height = 0;  ///< device pixels
    double pixelRatio = 1;      ///< device pixels per logical pixel
};

class Renderer {
public:
    explicit Renderer(const GlFunctions& gl);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    void draw(const StageFrame& frame, const Camera& camera, const RenderTarget& target);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace extremal
