// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_widget.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "ui/base/theme.hpp"
#include "ui/stage/stage_canvas.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/gl/surface.hpp"
#include "ui/stage/tension_lines.hpp"

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
    bool isSideBySide = false, hasPotential = false;
    StageTrails trails = StageTrails::fading;
    StageLook framed;  ///< the look of the frame
    double t = 0;
    std::optional<Camera> chosen;  ///< the user's view; empty: everything is shown
    QPointF dragged;
    bool isDragging = false, isStroke = false, isDrawing = false;
    std::optional<StagePlayer::Grip> hovered;  ///< the body under the pointer
    std::optional<StagePlayer::Grip> gripped;  ///< that which is dragged
    std::optional<Camera> held;                ///< the view while it is dragged
    std::optional<Point> arrow;                ///< the end of the velocity that it is given
    std::optional<Drawing> ghost;
    struct Moment {
        quint64 ms;  ///< of the event, not of when it was dealt with
        QPointF place;
    };
    std::deque<Moment> recent;  ///< of the pointer, while a body is dragged
    QPointF taken;              ///< where it was pressed
    std::vector<Point> sketch;
    OverlayOptions overlay;
    bool hasGrid = false;

    Camera camera() const {
        if (held) return *held;
        return chosen ? *chosen : fitted();
    }
    /// The motion fills the widget but for a margin, and a line of words at the foot.
    Camera fitted() const {
        constexpr double part = 0.08, least = 14;
        const double height = heightOfPicture();
        const double margin = std::max(least, part * std::min<double>(self->width(), height));
        Camera camera = player.fittedCamera(self->width(), height, margin, look());
        camera.centre = camera.unproject(0, -(self->height() - height) / 2);
        return camera;
    }
    double heightOfPicture() const {
        constexpr double foot = 20;
        return self->height() - foot;
    }
    StageLook look() const {
        StageLook found{{}, trails, hasPotential && !isSideBySide};
        Camera direction;
        if (player.isSpatial()) direction = chosen ? *chosen : player.fittedCamera(100, 100, 0);
        if (isSideBySide && player.hasStage())
            found.tiling = player.tilingFor(self->width(), heightOfPicture(), direction);
        return found;
    }
    const StageFrame& currentFrame() {
        const StageLook wanted = look();
        if (!isFrameCurrent || !(wanted == framed)) {
            framed = wanted;
            StageStyle style = stageStyle(theme);
            style.hasGrid = hasGrid;
            frame = player.frame(t, style, framed);
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
            paintTensions(painter);
            paintOverlay(painter, area, currentFrame(), player, theme, {overlay.hasLegend, camera()});
            paintSketch(painter);
            paintHand(painter);
        } else
            paintMessage(painter, player.comparison() && !player.comparison()->schemes.empty()
                                      ? QStringLiteral("Waiting for the first step")
                                      : QStringLiteral("Nothing to show yet"));
    }
    /// Rods that are pulled and rods that are pressed, the stronger the more visible.
    void paintTensions(QPainter& painter) const {
        painter.setRenderHint(QPainter::Antialiasing);
        for (const TensionLine& line : tensionLines(player, t)) {
            QColor colour = line.pull > 0 ? theme.error : theme.good;
            colour.setAlphaF(static_cast<float>(std::min(1.0, std::sqrt(std::abs(line.pull)))));
            painter.setPen(QPen(colour, 6, Qt::SolidLine, Qt::FlatCap));
            painter.drawLine(onWidget(line.a), onWidget(line.b));
        }
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
    QPointF onWidget(const Point& p) const {
        const Point at = camera().project(p);
        return {self->width() / 2.0 + at[0], self->height() / 2.0 - at[1]};
    }
    /// The body under the pointer or in the hand, and what becomes of it.
    void paintHand(QPainter& painter) const {
        painter.setRenderHint(QPainter::Antialiasing);
        if (ghost) paintGhost(painter);
        const StagePlayer::Grip* const body = gripped ? &*gripped : hovered ? &*hovered : nullptr;
        if (!body) return;
        painter.setFont(theme.caption());
        painter.setPen(theme.muted);
        // Above the line of the time and the trail.
        painter.drawText(QRectF(0, 0, self->width() - 12, self->height() - 24),
                         Qt::AlignRight | Qt::AlignBottom,
                         QStringLiteral("drag: start from here   Shift and drag, or throw: velocity"));
        Point place = body->place;
        if (gripped && ghost)
            if (const std::optional<Point> point = gripped->held.in(*ghost)) place = inTile(*point);
        const QPointF at = onWidget(place);
        painter.setPen(QPen(theme.accent, 2));
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(at, 13, 13);
        if (!arrow) return;
        const QPointF end = onWidget(*arrow);
        painter.drawLine(at, end);
        const double angle = std::atan2(end.y() - at.y(), end.x() - at.x());
        for (const double side : {2.6, -2.6})
            painter.drawLine(end, end + 9 * QPointF(std::cos(angle + side), std::sin(angle + side)));
    }
    /// Where the scheme in the hand stands.
    Point inTile(Point p) const {
        if (gripped)
            for (std::size_t i = 0; i < 3; ++i) p[i] += gripped->offset[i];
        return p;
    }
    void paintGhost(QPainter& painter) const {
        QColor colour = theme.accent;
        colour.setAlphaF(0.75f);
        painter.setPen(QPen(colour, 2));
        for (const Shape& shape : ghost->shapes) {
            if (const auto* rod = std::get_if<Segment>(&shape); rod && rod->role == ShapeRole::body)
                painter.drawLine(onWidget(inTile(rod->a)), onWidget(inTile(rod->b)));
            if (const auto* spring = std::get_if<Spring>(&shape))
                painter.drawLine(onWidget(inTile(spring->a)), onWidget(inTile(spring->b)));
            if (const auto* solid = std::get_if<Solid>(&shape); solid && !solid->isSmooth)
                for (const std::vector<int>& face : solid->faces) {
                    QPolygonF outline;
                    for (const int corner : face)
                        outline.append(onWidget(inTile(solid->corners[static_cast<std::size_t>(corner)])));
                    painter.drawPolygon(outline);
                }
            if (const auto* disc = std::get_if<Disc>(&shape); disc && disc->role == ShapeRole::body) {
                painter.setBrush(colour);
                painter.drawEllipse(onWidget(inTile(disc->centre)), disc->radius, disc->radius);
                painter.setBrush(Qt::NoBrush);
            }
        }
    }
    std::optional<StagePlayer::Grip> gripAt(QPointF place) const {
        constexpr double reach = 6;
        return player.gripAt(t, camera(), place.x() - self->width() / 2.0, self->height() / 2.0 - place.y(),
                             reach, look().tiling);
    }
    /// The point as deep as `from` that is seen so many pixels right of it and above it.
    Point beside(const Point& from, QPointF by) const {
        const Camera seen = camera();
        const auto axes = seen.axes();
        Point r = from;
        for (std::size_t i = 0; i < 3; ++i)
            r[i] += (axes[0][i] * by.x() - axes[1][i] * by.y()) / seen.pixelsPerUnit;
        return r;
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
        const double least = 1e-6 * fitted().pixelsPerUnit;
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
    setMouseTracking(true);
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
    if (!impl_->gripped) impl_->hovered.reset();  // it has moved on
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
void StageWidget::setGhost(std::optional<Drawing> ghost) {
    impl_->ghost = std::move(ghost);
    impl_->words->update();
}
void StageWidget::setSketch(std::vector<Point> points) {
    impl_->sketch = std::move(points);
    impl_->words->update();
}

void StageWidget::setSideBySide(bool isSideBySide) {
    impl_->isSideBySide = isSideBySide;
    fit();
    impl_->changed();
}
bool StageWidget::isSideBySide() const { return impl_->isSideBySide; }

void StageWidget::setTrails(StageTrails trails) {
    impl_->trails = trails;
    impl_->changed();
}
StageTrails StageWidget::trails() const { return impl_->trails; }

void StageWidget::setPotentialShown(bool isShown) {
    impl_->hasPotential = isShown;
    impl_->changed();
}
bool StageWidget::isPotentialShown() const { return impl_->hasPotential; }
bool StageWidget::hasPotential() const { return impl_->player.hasPotential(); }

void StageWidget::fit() { impl_->choose(std::nullopt); }
void StageWidget::zoom(double factor) { impl_->zoomAt(factor, QRectF(rect()).center()); }
Camera StageWidget::camera() const { return impl_->camera(); }
void StageWidget::setCamera(const Camera& camera) { impl_->choose(camera); }
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
    if (!impl_->isStroke) {
        impl_->gripped = impl_->gripAt(event->position());
        setCursor(Qt::ClosedHandCursor);
        if (!impl_->gripped) return;
        impl_->held = impl_->camera();
        impl_->taken = event->position();
        impl_->recent.clear();
        emit bodyTaken(*impl_->gripped);
        return;
    }
    setCursor(Qt::CrossCursor);
    emit strokeStarted();
    emit stroke(impl_->under(event->position()), impl_->under(event->position()));
}

void StageWidget::mouseMoveEvent(QMouseEvent* event) {
    if (!impl_->isDragging) {
        const bool had = impl_->hovered.has_value();
        impl_->hovered = impl_->gripAt(event->position());
        if (impl_->hovered) setCursor(Qt::OpenHandCursor);
        if (!impl_->hovered && had) unsetCursor();
        if (had || impl_->hovered) impl_->words->update();
        return QWidget::mouseMoveEvent(event);
    }
    if (impl_->gripped) return moveBody(*event);
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

void StageWidget::mouseReleaseEvent(QMouseEvent* event) {
    impl_->isDragging = false;
    unsetCursor();
    if (impl_->gripped) return letBody(event->timestamp());
    if (std::exchange(impl_->isStroke, false)) emit strokeEnded();
}

void StageWidget::moveBody(const QMouseEvent& event) {
    constexpr std::size_t most = 64;
    impl_->recent.push_back({event.timestamp(), event.position()});
    if (impl_->recent.size() > most) impl_->recent.pop_front();
    const bool isVelocity = event.modifiers() & Qt::ShiftModifier;
    const Point target = impl_->beside(impl_->gripped->place, event.position() - impl_->taken);
    if (isVelocity)
        impl_->arrow = target;
    else
        impl_->arrow.reset();
    impl_->words->update();
    Point own = target;  // where the scheme stands together with the others
    for (std::size_t i = 0; i < 3; ++i) own[i] -= impl_->gripped->offset[i];
    emit bodyMoved(own, isVelocity);
}

/// The pointer's velocity is that of its last tenth of a second; one that rests before throws nothing.
void StageWidget::letBody(quint64 now) {
    constexpr quint64 lately = 100;
    constexpr double slow = 250;  // pixels per second
    while (!impl_->recent.empty() && impl_->recent.front().ms + lately < now) impl_->recent.pop_front();
    QPointF speed;
    if (impl_->recent.size() > 1 && !impl_->arrow) {
        const auto &first = impl_->recent.front(), &last = impl_->recent.back();
        speed = (last.place - first.place) *
                (1000.0 / static_cast<double>(std::max<quint64>(1, now - std::min(now, first.ms))));
    }
    if (std::hypot(speed.x(), speed.y()) < slow) speed = {};
    const Point velocity = impl_->beside({}, speed);
    impl_->gripped.reset();
    impl_->hovered.reset();
    impl_->held.reset();
    impl_->arrow.reset();
    emit bodyLet(velocity);
    impl_->repaint();
}

void StageWidget::leaveEvent(QEvent* event) {
    if (std::exchange(impl_->hovered, std::nullopt)) impl_->words->update();
    QWidget::leaveEvent(event);
}

void StageWidget::mouseDoubleClickEvent(QMouseEvent*) {
    impl_->isDragging = false;
    fit();
}

}  // namespace extremal
