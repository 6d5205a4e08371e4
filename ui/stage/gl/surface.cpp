// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/surface.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace extremal {

std::unique_ptr<Surface> makeHeadlessSurface() {
    const char* wanted = std::getenv("EXTREMAL_SURFACE");
    return wanted && std::string_view(wanted) == "egl" ? makeEglSurface() : makeOsmesaSurface();
}

std::string describeSurface(Surface& surface) {
    surface.begin(64, 64);
    const auto textOf = [&](unsigned name) {
        const auto* const text = reinterpret_cast<const char*>(surface.functions().GetString(name));
        return std::string(text ? text : "unknown");
    };
    return textOf(GL_RENDERER) + ", OpenGL " + textOf(GL_VERSION);
}

StagePainter::StagePainter(std::unique_ptr<Surface> surface) : surface_(std::move(surface)) {}

StagePainter::~StagePainter() {
    if (!renderer_) return;
    try {
        surface_->begin(1, 1);  // the renderer frees its objects in its own context
        renderer_.reset();
    } catch (const OpenGlUnavailable&) {
        (void)renderer_.release();  // without a context its objects cannot be freed; they go with the surface
    }
}

QImage StagePainter::draw(const StageFrame& frame, const Camera& camera, int width, int height,
                          double pixelRatio) {
    const unsigned framebuffer = surface_->begin(width, height);
    const GlFunctions& gl = surface_->functions();
    if (!renderer_) renderer_ = std::make_unique<Renderer>(gl);
    renderer_->draw(frame, camera, {framebuffer, width, height, pixelRatio});
    gl.Finish();
    QImage image(width, height, QImage::Format_RGBX8888);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.bits());
    image.mirror();  // OpenGL counts rows from the bottom
    image.setDevicePixelRatio(pixelRatio);
    return image;
}

}  // namespace extremal
