// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/gl_widget_renderer.hpp"

#include "ui/stage/gl/gl_functions.hpp"
#include "ui/stage/gl/renderer.hpp"

namespace extremal {

struct GlWidgetRenderer::Impl {
    std::unique_ptr<const GlFunctions> gl;
    Renderer renderer;
    explicit Impl(std::unique_ptr<const GlFunctions> functions) : gl(std::move(functions)), renderer(*gl) {}
};

GlWidgetRenderer::GlWidgetRenderer(const std::function<void (*(const char* name))()>& getProcAddress)
    : impl_(std::make_unique<Impl>(loadGlFunctions(getProcAddress))) {}

GlWidgetRenderer::~GlWidgetRenderer() = default;

void GlWidgetRenderer::draw(const StageFrame& frame, const Camera& camera, unsigned framebuffer, int width,
                            int height, double pixelRatio) {
    impl_->renderer.draw(frame, camera, {framebuffer, width, height, pixelRatio});
}

}  // namespace extremal
