// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_canvas.hpp"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QPainter>
#include <QSurfaceFormat>

#include <cmath>

#include "ui/stage/gl/gl_widget_renderer.hpp"
#include "ui/stage/stage_picture.hpp"

namespace extremal {
namespace {

QSurfaceFormat wantedFormat() {
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    return format;
}

/// On the graphics card, within the window's own composition.
class GlCanvas : public QOpenGLWidget {
public:
    GlCanvas(QWidget* parent, CanvasSource source) : QOpenGLWidget(parent), source_(std::move(source)) {
        setFormat(wantedFormat());
    }
    ~GlCanvas() override { release(); }
    GlCanvas(const GlCanvas&) = delete;
    GlCanvas& operator=(const GlCanvas&) = delete;

protected:
    void initializeGL() override {
        // Moving the widget to another window destroys its context, and with it everything made there.
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { release(); });
        try {
            renderer_ = std::make_unique<GlWidgetRenderer>(
                [context = context()](const char* name) { return context->getProcAddress(name); });
        } catch (const std::exception& e) {
            source_.fail(QString::fromUtf8(e.what()));
        }
    }
    void paintGL() override {
        if (!renderer_) return;
        const double ratio = devicePixelRatioF();
        const auto pixels = [&](int length) { return static_cast<int>(std::lround(length * ratio)); };
        try {
            renderer_->draw(source_.frame(), source_.camera(), defaultFramebufferObject(), pixels(width()),
                            pixels(height()), ratio);
        } catch (const std::exception& e) {
            source_.fail(QString::fromUtf8(e.what()));
        }
    }

private:
    void release() {
        if (!renderer_) return;
        makeCurrent();
        renderer_.reset();
        doneCurrent();
    }
    CanvasSource source_;
    std::unique_ptr<GlWidgetRenderer> renderer_;
};

/// Pictures of an offscreen surface in a plain widget.
class PictureCanvas : public QWidget {
public:
    PictureCanvas(QWidget* parent, CanvasSource source) : QWidget(parent), source_(std::move(source)) {
        setAttribute(Qt::WA_OpaquePaintEvent);
    }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        const double ratio = devicePixelRatioF();
        try {
            const QImage image = drawStage(source_.frame(), source_.camera(), QSizeF(size()), ratio);
            painter.drawImage(QPointF(0, 0), image);
        } catch (const std::exception& e) {
            source_.fail(QString::fromUtf8(e.what()));
        }
    }

private:
    CanvasSource source_;
};

/// The renderer of a graphics card; empty: there is none.
QString probe() {
    const QString platform = QGuiApplication::platformName();
    if (platform == QLatin1String("offscreen") || platform == QLatin1String("minimal")) return {};
    const QByteArray wanted = qgetenv("EXTREMAL_STAGE");
    if (wanted == "picture") return {};
    QOpenGLContext context;
    context.setFormat(wantedFormat());
    if (!context.create()) return {};
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!context.makeCurrent(&surface)) return {};
    const auto version = context.format().version();
    const auto* name = reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER));
    const QString renderer = QString::fromLatin1(name ? name : "");
    context.doneCurrent();
    const bool isSoftware = renderer.contains(QLatin1String("llvmpipe")) ||
                            renderer.contains(QLatin1String("softpipe")) ||
                            renderer.contains(QLatin1String("swrast"), Qt::CaseInsensitive);
    const bool isUsed = version >= std::make_pair(3, 3) && (!isSoftware || wanted == "opengl");
    return isUsed ? renderer : QString();
}

}  // namespace

QString graphicsCard() {
    static const QString name = probe();
    return name;
}

bool hasGraphicsCard() { return !graphicsCard().isEmpty(); }

QWidget* makeCanvas(QWidget* parent, CanvasSource source, bool usesGraphicsCard) {
    QWidget* canvas = nullptr;
    if (usesGraphicsCard)
        canvas = new GlCanvas(parent, std::move(source));
    else
        canvas = new PictureCanvas(parent, std::move(source));
    canvas->setAttribute(Qt::WA_TransparentForMouseEvents);
    canvas->setFocusPolicy(Qt::NoFocus);
    return canvas;
}

}  // namespace extremal
