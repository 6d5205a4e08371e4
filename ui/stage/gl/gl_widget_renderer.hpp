// SPDX-License-Identifier: GPL-3.0-or-later
/// The renderer in somebody else's OpenGL context. Apart from surface.hpp, because Qt's OpenGL headers and
/// GL/glcorearb.h do not go together.
#pragma once

#include <functional>
#include <memory>

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

/// Construct, use and destroy it with the context current. Throws OpenGlUnavailable (a std::runtime_error).
class GlWidgetRenderer {
public:
    explicit GlWidgetRenderer(const std::function<void (*(const char* name))()>& getProcAddress);
    ~GlWidgetRenderer();
    void draw(const StageFrame& frame, const Camera& camera, unsigned framebuffer, int width, int height,
              double pixelRatio);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace extremal
