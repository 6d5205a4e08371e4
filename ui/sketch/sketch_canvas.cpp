// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/sketch/sketch_canvas.hpp"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/base/theme.hpp"

namespace extremal {
namespace {

constexpr double clickReach = 12;  // pixels
constexpr double slop = 6;         // of a click

bool isLink(SketchTool::Kind tool) {
    using Kind = SketchTool::Kind;
    return tool == Kind::rod || tool == Kind::spring || tool == Kind::damper || tool == Kind::pin ||
           tool == Kind::body || tool == Kind::slider || tool == Kind::wall;
}

const char* kindOf(SketchTool::Kind tool) {
    using Kind = SketchTool::Kind;
    return tool == Kind::rod      ? "rods"
           : tool == Kind::spring ? "springs"
           : tool == Kind::damper ? "dampers"
                                  : "pins";
}

const Theme& plainTheme() {
    static const Theme theme = Theme::light();
    return theme;
}

}  // namespace

const std::vector<SketchTool>& sketchTools() {
    using Kind = SketchTool::Kind;
    static const std::vector<SketchTool> all = {
        {Kind::select, QObject::tr("Select"), Qt::Key_V,
         QObject::tr("click selects, drag moves, Delete removes")},
        {Kind::point, QObject::tr("Point"), Qt::Key_P, QObject::tr("click: a point with a mass")},
        {Kind::fixedPoint, QObject::tr("Fixed"), Qt::Key_F,
         QObject::tr("click: a fixed point, or fix one that is there")},
        {Kind::rod, QObject::tr("Rod"), Qt::Key_R, QObject::tr("drag from point to point, or click both")},
        {Kind::spring, QObject::tr("Spring"), Qt::Key_S,
         QObject::tr("drag from point to point, or click both")},
        {Kind::damper, QObject::tr("Damper"), Qt::Key_D,
         QObject::tr("drag from point to point; two clicks on one point: to the ground")},
        {Kind::pin, QObject::tr("Pin"), Qt::Key_N,
         QObject::tr("drag from point to point: they stay together")},
        {Kind::body, QObject::tr("Body"), Qt::Key_B,
         QObject::tr("drag: a bar, pinned to points at its ends")},
        {Kind::slider, QObject::tr("Slider"), Qt::Key_L, QObject::tr("drag from a point along its line")},
        {Kind::motor, QObject::tr("Motor"), Qt::Key_M,
         QObject::tr("click a rod with a fixed end, or a body")},
        {Kind::wall, QObject::tr("Wall"), Qt::Key_W,
         QObject::tr("drag along the wall; points keep to their side")}};
    return all;
}

SketchCanvas::SketchCanvas(QWidget* parent) : QWidget(parent), theme_(&plainTheme()) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Drawing of the mechanism"));
    setProperty("help", "mechanisms");  // of F1
}

void SketchCanvas::setTheme(const Theme& theme) {
    theme_ = &theme;
    update();
}

void SketchCanvas::setCamera(const Camera& camera) {
    if (camera == camera_) return;
    camera_ = camera;
    update();
    emit cameraChanged();
}

void SketchCanvas::setOpaque(bool isOpaque) {
    isOpaque_ = isOpaque;
    update();
}

void SketchCanvas::setNote(const QString& note) {
    note_ = note;
    update();
}

void SketchCanvas::begin(const MechanismDrawing& drawing) {
    drawing_ = drawing;
    moving_.reset();
    from_.reset();
    select({});
    update();
}

void SketchCanvas::afterChange() {
    if (selected_ && !drawing_.find(*selected_)) select({});
    update();
    emit changed();
}

void SketchCanvas::select(std::optional<MechanismDrawing::Element> element) {
    selected_ = std::move(element);
    update();
    emit selectionChanged();
}

void SketchCanvas::setTool(SketchTool::Kind tool) {
    tool_ = tool;
    from_.reset();
    firstClick_ = false;
    setCursor(tool == SketchTool::Kind::select ? Qt::ArrowCursor : Qt::CrossCursor);
    update();
    emit toolChanged();
}

SketchCanvas::Place SketchCanvas::under(QPointF at) const {
    const Point p = camera_.unproject(at.x() - width() / 2.0, height() / 2.0 - at.y());
    return {p[0], p[1]};
}

QPointF SketchCanvas::onSheet(const Place& place) const {
    const Point at = camera_.project({place[0], place[1], 0});
    return {width() / 2.0 + at[0], height() / 2.0 - at[1]};
}

double SketchCanvas::reach() const { return clickReach / camera_.pixelsPerUnit; }

/// 1, 2 or 5 times a power of ten that has room between its lines.
double SketchCanvas::gridStep() const {
    constexpr double least = 22;
    const double wanted = least / camera_.pixelsPerUnit, power = std::pow(10, std::floor(std::log10(wanted)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= wanted) return factor * power;
    return 10 * power;
}

SketchCanvas::Place SketchCanvas::snapped(QPointF at, Qt::KeyboardModifiers modifiers) const {
    const Place place = under(at);
    if (const auto point = drawing_.pointAt(place, reach()); point && point != dragged_)
        return drawing_.placeOf(*point).value_or(place);
    if (modifiers & Qt::AltModifier) return place;
    const double step = gridStep();
    return {std::round(place[0] / step) * step, std::round(place[1] / step) * step};
}

void SketchCanvas::pressSelect(QPointF at) {
    const Place place = under(at);
    select(drawing_.elementAt(place, reach()));
    if (selected_ && drawing_.placeOf(*selected_)) {
        dragged_ = selected_;
        moving_ = drawing_;
    } else if (!selected_) {
        panned_ = at;
    }
}

void SketchCanvas::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) {
        panned_ = event->position();
        return;
    }
    setFocus();
    pressed_ = event->position();
    if (tool_ == SketchTool::Kind::select) return pressSelect(event->position());
    if (isLink(tool_) && !from_) from_ = snapped(event->position(), event->modifiers());
}

void SketchCanvas::mouseMoveEvent(QMouseEvent* event) {
    hasPointer_ = true;
    pointer_ = snapped(event->position(), event->modifiers());
    if (panned_) {
        const QPointF by = event->position() - std::exchange(panned_, event->position()).value();
        Camera next = camera_;
        next.centre = next.unproject(-by.x(), by.y());
        setCamera(next);
    } else if (dragged_ && pressed_ && (event->position() - *pressed_).manhattanLength() > 3) {
        moving_ = MechanismDrawing(drawing_.model());
        moving_->move(*dragged_, pointer_);
    }
    update();
}

void SketchCanvas::mouseReleaseEvent(QMouseEvent* event) {
    const bool wasPanned = std::exchange(panned_, std::nullopt).has_value();
    const auto pressed = std::exchange(pressed_, std::nullopt);
    if (event->button() != Qt::LeftButton || !pressed) return;
    const Place place = snapped(event->position(), event->modifiers());
    if (dragged_) {
        const auto element = *std::exchange(dragged_, std::nullopt);
        const std::optional<MechanismDrawing> moved = std::exchange(moving_, std::nullopt);
        if (moved && !(moved->model() == drawing_.model()))
            change([&](MechanismDrawing& drawing) { drawing.replace(moved->model()); });
        select(element);
        return;
    }
    if (tool_ == SketchTool::Kind::select || wasPanned) return;
    const QPointF by = event->position() - *pressed;
    const bool isClick = std::hypot(by.x(), by.y()) < slop;
    if (!isLink(tool_)) return click(place);
    if (isClick) return clickLink(place);
    firstClick_ = false;
    drag(*std::exchange(from_, std::nullopt), place);
}

/// The first click of a link says where it begins, the second one where it ends.
void SketchCanvas::clickLink(const Place& place) {
    if (!firstClick_) {
        firstClick_ = true;
        update();
        return;
    }
    firstClick_ = false;
    drag(*std::exchange(from_, std::nullopt), place);
}

void SketchCanvas::click(const Place& place) {
    using Kind = SketchTool::Kind;
    const auto there = drawing_.pointAt(place, reach());
    std::optional<MechanismDrawing::Element> made = there;
    if (tool_ == Kind::motor) {
        const auto element = drawing_.elementAt(place, reach());
        if (element) change([&](MechanismDrawing& drawing) { made = drawing.addMotor(*element); });
    } else if (tool_ == Kind::fixedPoint && there) {
        change([&](MechanismDrawing& drawing) { drawing.toggleFixed(there->name); });
    } else if (!there) {
        change([&](MechanismDrawing& drawing) { made = drawing.addPoint(place, tool_ == Kind::fixedPoint); });
    }
    if (made) select(made);
}

void SketchCanvas::drag(const Place& from, const Place& to) {
    using Kind = SketchTool::Kind;
    std::optional<MechanismDrawing::Element> made;
    const auto point = drawing_.pointAt(from, reach());
    const bool isOnePlace = std::hypot(to[0] - from[0], to[1] - from[1]) < reach();
    if (tool_ == Kind::damper && isOnePlace && point)
        change([&](MechanismDrawing& d) { made = d.addGroundDamper(point->name); });
    else if (isOnePlace)
        return update();
    else if (tool_ == Kind::wall)
        change([&](MechanismDrawing& d) { made = d.addWall(from, to); });
    else if (tool_ == Kind::body)
        change([&](MechanismDrawing& d) { made = d.addBody(from, to, reach()); });
    else if (tool_ == Kind::slider && point)
        change([&](MechanismDrawing& d) { made = d.addSlider(point->name, to); });
    else if (tool_ != Kind::slider)
        change([&](MechanismDrawing& d) { made = d.addLink(kindOf(tool_), from, to, reach()); });
    if (made) select(made);
}

void SketchCanvas::wheelEvent(QWheelEvent* event) {
    const Place place = under(event->position());
    Camera next = camera_;
    next.pixelsPerUnit =
        std::clamp(next.pixelsPerUnit * std::pow(1.0015, event->angleDelta().y()), 1e-3, 1e6);
    const Point moved =
        next.unproject(event->position().x() - width() / 2.0, height() / 2.0 - event->position().y());
    for (std::size_t i = 0; i < 2; ++i) next.centre[i] += place[i] - moved[i];
    setCamera(next);
    event->accept();
}

bool SketchCanvas::takesKey(const QKeyEvent& key) const {
    if (key.matches(QKeySequence::Undo) || key.matches(QKeySequence::Redo)) return true;
    if (key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
    if (key.key() == Qt::Key_Escape || key.key() == Qt::Key_Delete || key.key() == Qt::Key_Backspace)
        return true;
    const auto& tools = sketchTools();
    return std::any_of(tools.begin(), tools.end(),
                       [&](const SketchTool& tool) { return tool.key == key.key(); });
}

/// The keys of the tools are those of the sheet while it has the focus.
bool SketchCanvas::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && takesKey(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void SketchCanvas::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Undo)) return change([](MechanismDrawing& d) { d.undo(); });
    if (event->matches(QKeySequence::Redo)) return change([](MechanismDrawing& d) { d.redo(); });
    if (!takesKey(*event)) return QWidget::keyPressEvent(event);
    if (event->key() == Qt::Key_Escape) {
        const bool wasAtWork = from_ || tool_ != SketchTool::Kind::select || selected_;
        setTool(SketchTool::Kind::select);
        select({});
        if (!wasAtWork) emit left();
        return;
    }
    if (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace) {
        if (const auto gone = selected_) change([&](MechanismDrawing& d) { d.remove(*gone); });
        return;
    }
    for (const SketchTool& tool : sketchTools())
        if (tool.key == event->key()) setTool(tool.kind);
}

void SketchCanvas::leaveEvent(QEvent* event) {
    hasPointer_ = false;
    update();
    QWidget::leaveEvent(event);
}

}  // namespace extremal
