// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/renderer.hpp"

#include "ui/stage/gl/gl_functions.hpp"
#include "ui/stage/gl/shaders.hpp"
#include "ui/stage/strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace extremal {
namespace {

GLuint compile(const GlFunctions& gl, GLenum kind, const char* source) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    GLint isCompiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    if (!isCompiled) {
        std::array<char, 1024> log{};
        gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
        gl.DeleteShader(shader);
        throw OpenGlUnavailable(std::string("the graphics driver refuses a shader of the stage: ") +
                                log.data());
    }
    return shader;
}

GLuint link(const GlFunctions& gl, const char* vertex, const char* fragment) {
    const GLuint v = compile(gl, GL_VERTEX_SHADER, vertex), f = compile(gl, GL_FRAGMENT_SHADER, fragment);
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, v);
    gl.AttachShader(program, f);
    gl.LinkProgram(program);
    gl.DeleteShader(v);
    gl.DeleteShader(f);
    GLint isLinked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &isLinked);
    if (!isLinked) {
        std::array<char, 1024> log{};
        gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
        gl.DeleteProgram(program);
        throw OpenGlUnavailable(std::string("the graphics driver cannot link the stage's shaders: ") +
                                log.data());
    }
    return program;
}

/// Clip coordinates of a point relative to the camera's centre; column-major. Depth spans some thousand
/// pixels.
std::array<float, 16> viewMatrix(const Camera& camera, const RenderTarget& target) {
    const auto rows = camera.axes();
    const double scale = camera.pixelsPerUnit * target.pixelRatio;
    const double perAxis[3] = {2 * scale / target.width, 2 * scale / target.height, -scale / 1e5};
    std::array<float, 16> m{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            m[column * 4 + row] = static_cast<float>(perAxis[row] * rows[row][column]);
    m[15] = 1;
    return m;
}

}  // namespace

struct Renderer::Impl {
    const GlFunctions& gl;
    GLuint strokeProgram = 0, fillProgram = 0, layerProgram = 0;
    GLuint vertexArray = 0, fillArray = 0, emptyArray = 0, buffer = 0, fillBuffer = 0;
    GLuint layerTexture = 0, layerFramebuffer = 0;
    int layerWidth = 0, layerHeight = 0;

    explicit Impl(const GlFunctions& functions) : gl(functions) {
        strokeProgram = link(gl, shaders::strokeVertex, shaders::strokeFragment);
        fillProgram = link(gl, shaders::fillVertex, shaders::fillFragment);
        layerProgram = link(gl, shaders::layerVertex, shaders::layerFragment);
        gl.GenVertexArrays(1, &vertexArray);
        gl.GenVertexArrays(1, &fillArray);
        gl.GenVertexArrays(1, &emptyArray);
        gl.GenBuffers(1, &buffer);
        gl.GenBuffers(1, &fillBuffer);
    }

    ~Impl() {
        dropLayer();
        gl.DeleteBuffers(1, &fillBuffer);
        gl.DeleteBuffers(1, &buffer);
        gl.DeleteVertexArrays(1, &emptyArray);
        gl.DeleteVertexArrays(1, &fillArray);
        gl.DeleteVertexArrays(1, &vertexArray);
        gl.DeleteProgram(layerProgram);
        gl.DeleteProgram(fillProgram);
        gl.DeleteProgram(strokeProgram);
    }

    void dropLayer() {
        if (layerFramebuffer) gl.DeleteFramebuffers(1, &layerFramebuffer);
        if (layerTexture) gl.DeleteTextures(1, &layerTexture);
        layerFramebuffer = layerTexture = 0;
    }

    void makeLayer(int width, int height) {
        if (layerTexture && layerWidth == width && layerHeight == height) return;
        dropLayer();
        layerWidth = width;
        layerHeight = height;
        gl.GenTextures(1, &layerTexture);
        gl.BindTexture(GL_TEXTURE_2D, layerTexture);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.GenFramebuffers(1, &layerFramebuffer);
        gl.BindFramebuffer(GL_FRAMEBUFFER, layerFramebuffer);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, layerTexture, 0);
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw OpenGlUnavailable("the graphics driver cannot draw a picture of " + std::to_string(width) +
                                    "x" + std::to_string(height));
    }

    /// OpenGL 3.3 has no first instance: the attributes are pointed at the batch instead.
    void pointAt(std::size_t first) const {
        const auto attribute = [&](GLuint location, GLint size, std::size_t offset) {
            const std::size_t start = first * sizeof(Stroke) + offset;
            gl.EnableVertexAttribArray(location);
            gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(sizeof(Stroke)),
                                   reinterpret_cast<const void*>(start));
            gl.VertexAttribDivisor(location, 1);
        };
        attribute(0, 3, offsetof(Stroke, a));
        attribute(1, 3, offsetof(Stroke, b));
        attribute(2, 1, offsetof(Stroke, halfWidth));
        attribute(3, 3, offsetof(Stroke, colour));
        attribute(4, 2, offsetof(Stroke, alphaA));
    }

    void drawFills(const StrokeBatch& batch) const {
        if (batch.fillCount == 0) return;
        gl.BindVertexArray(fillArray);
        gl.UseProgram(fillProgram);
        gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(batch.fillFirst),
                      static_cast<GLsizei>(batch.fillCount));
    }

    /// The corners of all triangles, in a buffer of their own.
    void loadFills(const StrokeList& list) const {
        if (list.fills.empty()) return;
        gl.BindVertexArray(fillArray);
        gl.BindBuffer(GL_ARRAY_BUFFER, fillBuffer);
        gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.fills.size() * sizeof(FillCorner)),
                      list.fills.data(), GL_STREAM_DRAW);
        const auto attribute = [&](GLuint location, GLint size, std::size_t offset) {
            gl.EnableVertexAttribArray(location);
            gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE,
                                   static_cast<GLsizei>(sizeof(FillCorner)),
                                   reinterpret_cast<const void*>(offset));
        };
        attribute(0, 3, offsetof(FillCorner, r));
        attribute(1, 3, offsetof(FillCorner, colour));
        attribute(2, 1, offsetof(FillCorner, alpha));
    }

    void drawStrokes(const StrokeBatch& batch) const {
        drawFills(batch);
        if (batch.count == 0) return;
        gl.BindVertexArray(vertexArray);
        gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
        gl.UseProgram(strokeProgram);
        pointAt(batch.first);
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(batch.count));
    }

    void drawUnited(const StrokeBatch& batch, const RenderTarget& target) const {
        gl.BindFramebuffer(GL_FRAMEBUFFER, layerFramebuffer);
        gl.ClearColor(0, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        gl.BlendEquation(GL_MAX);
        drawStrokes(batch);
        gl.BlendEquation(GL_FUNC_ADD);
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        gl.BindVertexArray(emptyArray);
        gl.UseProgram(layerProgram);
        gl.BindTexture(GL_TEXTURE_2D, layerTexture);
        gl.Uniform1f(gl.GetUniformLocation(layerProgram, "opacity"), batch.opacity);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }

    /// Restricts drawing to the batch's pixels. False if none is in the picture.
    bool clip(const StrokeBatch& batch, const RenderTarget& target) const {
        const auto edge = [](float fromMiddle, int size) {
            return static_cast<int>(std::clamp(std::floor(fromMiddle + static_cast<float>(size) / 2), 0.f,
                                               static_cast<float>(size)));
        };
        const int x0 = edge(batch.low[0], target.width), x1 = edge(batch.high[0] + 1, target.width);
        const int y0 = edge(batch.low[1], target.height), y1 = edge(batch.high[1] + 1, target.height);
        gl.Scissor(x0, y0, std::max(x1 - x0, 0), std::max(y1 - y0, 0));
        return x1 > x0 && y1 > y0;
    }

    void draw(const StrokeList& list, const Camera& camera, const RenderTarget& target,
              const Rgb& background) {
        makeLayer(target.width, target.height);
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        gl.Viewport(0, 0, target.width, target.height);
        gl.Disable(GL_SCISSOR_TEST);
        gl.Disable(GL_DEPTH_TEST);
        gl.Disable(GL_CULL_FACE);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.ClearColor(background.r, background.g, background.b, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        gl.Enable(GL_SCISSOR_TEST);
        gl.Enable(GL_BLEND);
        gl.BlendEquation(GL_FUNC_ADD);
        gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        gl.ActiveTexture(GL_TEXTURE0);

        gl.UseProgram(strokeProgram);
        const auto matrix = viewMatrix(camera, target);
        gl.UniformMatrix4fv(gl.GetUniformLocation(strokeProgram, "view"), 1, GL_FALSE, matrix.data());
        gl.Uniform2f(gl.GetUniformLocation(strokeProgram, "halfSize"), static_cast<float>(target.width) / 2,
                     static_cast<float>(target.height) / 2);
        gl.UseProgram(fillProgram);
        gl.UniformMatrix4fv(gl.GetUniformLocation(fillProgram, "view"), 1, GL_FALSE, matrix.data());
        gl.UseProgram(layerProgram);
        gl.Uniform1i(gl.GetUniformLocation(layerProgram, "layer"), 0);
        loadFills(list);

        gl.BindVertexArray(vertexArray);
        gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
        gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.strokes.size() * sizeof(Stroke)),
                      list.strokes.data(), GL_STREAM_DRAW);
        for (const StrokeBatch& batch : list.batches) {
            if (!clip(batch, target)) continue;
            if (batch.isUnited)
                drawUnited(batch, target);
            else
                drawStrokes(batch);
        }
        leaveClean(target);
    }

    /// The window system draws with the same context afterwards: leave nothing of ours behind.
    void leaveClean(const RenderTarget& target) const {
        gl.Disable(GL_SCISSOR_TEST);
        gl.Disable(GL_BLEND);
        gl.BindVertexArray(0);
        gl.BindBuffer(GL_ARRAY_BUFFER, 0);
        gl.BindTexture(GL_TEXTURE_2D, 0);
        gl.UseProgram(0);
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    }
};

Renderer::Renderer(const GlFunctions& gl) : impl_(std::make_unique<Impl>(gl)) {}
Renderer::~Renderer() = default;

void Renderer::draw(const StageFrame& frame, const Camera& camera, const RenderTarget& target) {
    if (target.width < 1 || target.height < 1) return;
    const StrokeList list = makeStrokes(frame, camera, target.width / target.pixelRatio,
                                        target.height / target.pixelRatio, target.pixelRatio);
    impl_->draw(list, camera, target, frame.style.background);
}

}  // namespace extremal
