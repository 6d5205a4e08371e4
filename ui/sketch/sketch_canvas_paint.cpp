// SPDX-License-Identifier: GPL-3.0-or-later
/// What the sheet shows: the grid, the elements as an engineer draws them, and what the pointer is about to
/// do.
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

#include "ui/base/theme.hpp"
#include "ui/sketch/sketch_canvas.hpp"

namespace extremal {
namespace {

/// The line in parts, along it and across it, in pixels.
struct Frame {
    QPointF from, along, across;
    double length;
    Frame(QPointF a, QPointF b) : from(a), length(std::hypot((b - a).x(), (b - a).y())) {
        along = length > 0 ? (b - a) / length : QPointF(1, 0);
        across = {-along.y(), along.x()};
    }
    QPointF at(double x, double y) const { return from + x * along + y * across; }
};

void zigzag(QPainter& painter, const Frame& f) {
    constexpr int turns = 8;
    const double ends = std::min(12.0, 0.2 * f.length), pitch = (f.length - 2 * ends) / turns;
    QPolygonF line{f.at(0, 0), f.at(ends, 0)};
    for (int k = 0; k < turns; ++k) line << f.at(ends + (k + 0.5) * pitch, k % 2 ? -7 : 7);
    line << f.at(f.length - ends, 0) << f.at(f.length, 0);
    painter.drawPolyline(line);
}

void pot(QPainter& painter, const Frame& f) {
    const double a = 0.4 * f.length, b = 0.62 * f.length, c = 0.54 * f.length;
    painter.drawLine(f.at(0, 0), f.at(a, 0));
    painter.drawPolyline(QPolygonF{f.at(b, 7), f.at(a, 7), f.at(a, -7), f.at(b, -7)});
    painter.drawLine(f.at(c, 5), f.at(c, -5));
    painter.drawLine(f.at(c, 0), f.at(f.length, 0));
}

void hatching(QPainter& painter, const Frame& f) {
    painter.drawLine(f.at(0, 0), f.at(f.length, 0));
    for (double x = 8; x <= f.length; x += 10) painter.drawLine(f.at(x, 0), f.at(x - 8, 8));
}

void turning(QPainter& painter, QPointF axis, double radius) {
    painter.drawArc(QRectF(axis.x() - radius, axis.y() - radius, 2 * radius, 2 * radius), 30 * 16, 270 * 16);
    const QPointF tip = axis + radius * QPointF(std::cos(5.24), -std::sin(5.24));
    painter.drawLine(tip, tip + QPointF(-9, -1));
    painter.drawLine(tip, tip + QPointF(1, 9));
}

}  // namespace

void SketchCanvas::paintGrid(QPainter& painter) const {
    const double step = gridStep();
    const Place low = under(QPointF(0, height())), high = under(QPointF(width(), 0));
    QColor faint = theme_->line;
    for (double x = std::ceil(low[0] / step) * step; x <= high[0]; x += step) {
        faint.setAlphaF(std::abs(std::remainder(x, 5 * step)) < 1e-6 * step ? 0.7f : 0.3f);
        painter.setPen(QPen(faint, 1));
        painter.drawLine(onSheet({x, low[1]}), onSheet({x, high[1]}));
    }
    for (double y = std::ceil(low[1] / step) * step; y <= high[1]; y += step) {
        faint.setAlphaF(std::abs(std::remainder(y, 5 * step)) < 1e-6 * step ? 0.7f : 0.3f);
        painter.setPen(QPen(faint, 1));
        painter.drawLine(onSheet({low[0], y}), onSheet({high[0], y}));
    }
}

void SketchCanvas::paintLine(QPainter& painter, const MechanismDrawing::Line& line) const {
    const bool isSelected = selected_ == line.element;
    painter.setPen(
        QPen(isSelected ? theme_->accent : theme_->text, isSelected ? 3 : 2, Qt::SolidLine, Qt::RoundCap));
    painter.setBrush(Qt::NoBrush);
    const QPointF a = onSheet(line.a), b = onSheet(line.b);
    const std::string& kind = line.element.kind;
    if (kind == "springs") {
        zigzag(painter, {a, b});
    } else if (kind == "dampers") {
        if (a == b)
            painter.drawEllipse(a, 14, 14);
        else
            pot(painter, {a, b});
    } else if (kind == "walls") {
        hatching(painter, {b, a});  // on the side where nothing is
    } else if (kind == "motors") {
        turning(painter, a, 0.07 * drawing_.size() * camera_.pixelsPerUnit);
    } else if (kind == "sliders") {
        QPen pen = painter.pen();
        pen.setStyle(Qt::DashLine);
        pen.setWidth(1);
        painter.setPen(pen);
        painter.drawLine(a, b);
    } else if (kind == "pins") {
        painter.drawEllipse(a, 11, 11);
    } else {
        painter.setPen(QPen(painter.pen().color(), isSelected ? 5 : 4, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(a, b);
    }
}

void SketchCanvas::paintPoint(QPainter& painter, const MechanismDrawing& drawing,
                              const MechanismDrawing::Line& point) const {
    const bool isSelected = selected_ == point.element;
    const QPointF at = onSheet(point.a);
    const Value* const element = drawing.find(point.element);
    const bool isOfBody = element && element->find("body"), isBody = point.element.kind == "bodies";
    painter.setPen(QPen(isSelected ? theme_->accent : theme_->text, isSelected ? 3 : 2));
    painter.setBrush(isOfBody || isBody ? theme_->panel : theme_->muted);
    if (isOfBody)
        if (const auto centre = drawing.placeOf({"bodies", element->find("body")->asString()}))
            painter.drawLine(at, onSheet(*centre));
    if (drawing.isFixed(point.element.name)) {
        painter.setBrush(theme_->panel);
        painter.drawPolygon(QPolygonF{at, at + QPointF(-9, 14), at + QPointF(9, 14)});
        hatching(painter, {at + QPointF(-14, 14), at + QPointF(14, 14)});
        painter.drawEllipse(at, 4, 4);
    } else if (isBody) {
        painter.drawEllipse(at, 8, 8);
        painter.drawLine(at - QPointF(8, 0), at + QPointF(8, 0));
        painter.drawLine(at - QPointF(0, 8), at + QPointF(0, 8));
    } else {
        painter.drawEllipse(at, isOfBody ? 5 : 8, isOfBody ? 5 : 8);
    }
    painter.setPen(theme_->text);
    painter.setFont(theme_->caption());
    painter.drawText(at + QPointF(11, -8), QString::fromStdString(point.element.name));
}

void SketchCanvas::paintDrawing(QPainter& painter, const MechanismDrawing& drawing) const {
    for (const MechanismDrawing::Line& line : drawing.lines()) paintLine(painter, line);
    for (const MechanismDrawing::Line& point : drawing.points()) paintPoint(painter, drawing, point);
}

/// Where a click would be, and the link that it would make.
void SketchCanvas::paintHand(QPainter& painter) const {
    if (!hasPointer_ || tool_ == SketchTool::Kind::select) return;
    const QPointF at = onSheet(pointer_);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme_->accent, 1.5));
    if (drawing_.pointAt(pointer_, reach()))
        painter.drawEllipse(at, 13, 13);
    else
        painter.drawEllipse(at, 3, 3);
    if (!from_) return;
    painter.setPen(QPen(theme_->accent, 2, Qt::DashLine));
    painter.drawLine(onSheet(*from_), at);
}

void SketchCanvas::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor ground = theme_->panel;
    if (!isOpaque_) ground.setAlphaF(0.35f);
    painter.fillRect(rect(), ground);
    paintGrid(painter);
    paintDrawing(painter, moving_ ? *moving_ : drawing_);
    paintHand(painter);
    painter.setFont(theme_->caption());
    QString words = note_;
    for (const SketchTool& tool : sketchTools())
        if (words.isEmpty() && tool.kind == tool_) words = tool.name + ": " + tool.hint;
    painter.setPen(theme_->muted);
    painter.drawText(QRectF(rect()).adjusted(10, 6, -10, 0), Qt::AlignLeft | Qt::AlignTop, words);
}

}  // namespace extremal
