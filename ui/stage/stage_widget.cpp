// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_widget.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "ui/base/theme.hpp"
#include "ui/stage/stage_canvas.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/surface.hpp"

namespace extremal {
namespace {

/// The words, above the canvas.
class Words : public QWidget {
public:
    Words(QWidget* parent, std::function<void(QPainter&)> paint) : QWidget(parent), paint_(std::move(paint)) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setAttribute(Qt::WA_NoSystemBackground);
    }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        paint_(painter);
    }

private:
    std::function<void(QPainter&)> paint_;
};

}  // namespace

struct StageWidget::Impl {
    StageWidget* self = nullptr;
    QWidget* canvas = nullptr;
    QWidget* words = nullptr;
    QString failure;  ///< why nothing can be drawn
    bool usesGraphicsCard = false;
    Theme theme = Theme::light();
    StagePlayer player;
    StageFrame frame;
    bool isFrameCurrent = false;
    double t = 0;
    std::optional<Camera> chosen;  ///< the user's view; empty: everything is shown
    QPointF dragged;
    bool isDragging = false, isStroke = false, isDrawing = false;
    std::vector<Point> sketch;
    OverlayOptions overlay;
    bool hasGrid = false;

    Camera camera() const {
        return chosen ? *chosen : player.fittedCamera(self->width(), self->height(), stageMargin);
    }
    const StageFrame& currentFrame() {
        if (!isFrameCurrent) {
            StageStyle style = stageStyle(theme);
            style.hasGrid = hasGrid;
            frame = player.frame(t, style);
            isFrameCurrent = true;
        }
        return frame;
    }
    void paintWords(QPainter& painter) {
        const QRectF area(QPointF(0, 0), QSizeF(self->size()));
        if (!failure.isEmpty()) {
            painter.fillRect(area, theme.panel);
            paintMessage(painter, failure);
        } else if (player.hasStage()) {
            paintOverlay(painter, area, currentFrame(), player, theme, {overlay.hasLegend, camera()});
            paintSketch(painter);
        } else
            paintMessage(painter, player.comparison() && !player.comparison()->schemes.empty()
                                      ? QStringLiteral("Waiting for the first step")
                                      : QStringLiteral("Nothing to show yet"));
    }
    void paintSketch(QPainter& painter) const {
        if (sketch.empty()) return;
        const Camera seen = camera();
        QPolygonF line;
        for (const Point& p : sketch) {
            const Point at = seen.project(p);
            line << QPointF(self->width() / 2.0 + at[0], self->height() / 2.0 - at[1]);
        }
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(theme.accent, 2, Qt::DashLine));
        painter.drawPolyline(line);
    }
    /// The point of the model under a place of the widget.
    Point under(QPointF place) const {
        return camera().unproject(place.x() - self->width() / 2.0, self->height() / 2.0 - place.y());
    }
    void paintMessage(QPainter& painter, const QString& text) const {
        painter.setFont(theme.body());
        painter.setPen(theme.muted);
        painter.drawText(QRectF(QPointF(0, 0), QSizeF(self->size())).adjusted(16, 16, -16, -16),
                         Qt::AlignCenter | Qt::TextWordWrap, text);
    }
    void repaint() {
        canvas->update();
        words->update();
    }
    void changed() {
        isFrameCurrent = false;
        repaint();
    }
    void choose(const std::optional<Camera>& camera) {
        const bool wasFitted = !chosen;
        chosen = camera;
        repaint();
        if (wasFitted != !chosen) emit self->fittedChanged(!chosen);
    }
    /// Zooms so that the model point under this place of the widget stays there.
    void zoomAt(double factor, QPointF place) {
        Camera next = camera();
        const double x = place.x() - self->width() / 2.0, y = self->height() / 2.0 - place.y();
        const Point under = next.unproject(x, y);
        const double least =
            1e-6 * player.fittedCamera(self->width(), self->height(), stageMargin).pixelsPerUnit;
        next.pixelsPerUnit = std::clamp(next.pixelsPerUnit * factor, 1e5 * least, 1e12 * least);
        const Point moved = next.unproject(x, y);
        for (std::size_t i = 0; i < 3; ++i) next.centre[i] += under[i] - moved[i];
        choose(next);
    }
};

StageWidget::StageWidget(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
    impl_->self = this;
    impl_->usesGraphicsCard = hasGraphicsCard();
    CanvasSource source;
    source.frame = [this]() -> const StageFrame& { return impl_->currentFrame(); };
    source.camera = [this] { return impl_->camera(); };
    source.fail = [this](const QString& text) {
        impl_->failure = text;
        impl_->words->update();
    };
    impl_->canvas = makeCanvas(this, std::move(source), impl_->usesGraphicsCard);
    impl_->words = new Words(this, [this](QPainter& painter) { impl_->paintWords(painter); });
    setAccessibleName(QStringLiteral("Stage"));
    setAccessibleDescription(stageSummary(impl_->player));
}

StageWidget::~StageWidget() = default;

void StageWidget::setTheme(const Theme& theme) {
    impl_->theme = theme;
    impl_->changed();
}

void StageWidget::setComparison(std::shared_ptr<const Comparison> comparison) {
    setPlayer(StagePlayer(std::move(comparison)));
}

void StageWidget::setPlayer(StagePlayer player) {
    const Comparison *before = impl_->player.comparison(), *after = player.comparison();
    const bool isOtherModel = !before || !after || before->scene.model.type != after->scene.model.type;
    impl_->player = std::move(player);
    if (isOtherModel && impl_->chosen) fit();
    setAccessibleDescription(stageSummary(impl_->player));
    impl_->changed();
}

void StageWidget::setTime(double t) {
    if (t == impl_->t) return;
    impl_->t = t;
    impl_->changed();
}

double StageWidget::time() const { return impl_->t; }

void StageWidget::setLegendShown(bool isShown) {
    impl_->overlay.hasLegend = isShown;
    impl_->repaint();
}

void StageWidget::setGridShown(bool isShown) {
    impl_->hasGrid = isShown;
    impl_->changed();
}

void StageWidget::setDrawing(bool isOn) { impl_->isDrawing = isOn; }
bool StageWidget::isDrawing() const { return impl_->isDrawing; }
void StageWidget::setSketch(std::vector<Point> points) {
    impl_->sketch = std::move(points);
    impl_->words->update();
}

void StageWidget::fit() { impl_->choose(std::nullopt); }
void StageWidget::zoom(double factor) { impl_->zoomAt(factor, QRectF(rect()).center()); }
bool StageWidget::isFitted() const { return !impl_->chosen; }
bool StageWidget::usesGraphicsCard() const { return impl_->usesGraphicsCard; }

QString StageWidget::drawingBackend() const {
    if (impl_->usesGraphicsCard) return graphicsCard();
    const auto describe = [] {
        try {
            return QString::fromStdString(describeSurface(*makeHeadlessSurface()));
        } catch (const std::exception& e) {
            return QString::fromUtf8(e.what());
        }
    };
    return std::async(std::launch::async, describe).get();  // a thread has one current context
}

QImage StageWidget::picture(double pixelRatio) {
    const auto draw = [&] {
        return drawStage(impl_->currentFrame(), impl_->camera(), QSizeF(size()), pixelRatio);
    };
    // A thread has one current context: OSMesa must not take the place of the window's.
    QImage image = impl_->usesGraphicsCard ? std::async(std::launch::async, draw).get() : draw();
    QPainter painter(&image);
    impl_->paintWords(painter);
    return image;
}

void StageWidget::resizeEvent(QResizeEvent*) {
    impl_->failure.clear();
    impl_->canvas->setGeometry(rect());
    impl_->words->setGeometry(rect());
}

void StageWidget::wheelEvent(QWheelEvent* event) {
    impl_->zoomAt(std::pow(1.0015, event->angleDelta().y()), event->position());
    event->accept();
}

void StageWidget::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
    impl_->isDragging = true;
    impl_->dragged = event->position();
    const bool draws = impl_->isDrawing || (event->modifiers() & Qt::ControlModifier);
    impl_->isStroke = draws && impl_->player.hasStage() && !impl_->player.isSpatial();
    if (!impl_->isStroke) return setCursor(Qt::ClosedHandCursor);
    setCursor(Qt::CrossCursor);
    emit strokeStarted();
    emit stroke(impl_->under(event->position()), impl_->under(event->position()));
}

void StageWidget::mouseMoveEvent(QMouseEvent* event) {
    if (!impl_->isDragging) return QWidget::mouseMoveEvent(event);
    const QPointF by = event->position() - impl_->dragged;
    if (by.manhattanLength() < 1) return;
    const QPointF before = std::exchange(impl_->dragged, event->position());
    if (impl_->isStroke) {
        emit stroke(impl_->under(before), impl_->under(event->position()));
        return;
    }
    Camera next = impl_->camera();
    const bool turns = impl_->player.isSpatial() && !(event->modifiers() & Qt::ShiftModifier);
    if (turns) {
        constexpr double perPixel = 0.008;  // rad
        next.azimuth -= perPixel * by.x();
        next.elevation = std::clamp(next.elevation + perPixel * by.y(), -1.55, 1.55);
    } else {
        next.centre = next.unproject(-by.x(), by.y());
    }
    impl_->choose(next);
}

void StageWidget::mouseReleaseEvent(QMouseEvent*) {
    impl_->isDragging = false;
    unsetCursor();
    if (std::exchange(impl_->isStroke, false)) emit strokeEnded();
}

void StageWidget::mouseDoubleClickEvent(QMouseEvent*) {
    impl_->isDragging = false;
    fit();
}

}  // namespace extremal
