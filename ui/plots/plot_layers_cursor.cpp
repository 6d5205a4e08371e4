// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/sample.hpp"
#include "ui/plots/pill.hpp"
#include "ui/plots/plot_layers.hpp"

namespace extremal {

CursorLayer::CursorLayer(const FigurePlot::Shared& shared)
    : QCPLayerable(&shared.plot, "cursor"), shared_(shared) {}

void CursorLayer::draw(QCPPainter* painter) {
    const PixelMap map = shared_.map();
    const PlotCursors& c = shared_.cursors;
    if (c.pinned) drawCursor(*painter, map, *c.pinned, true);
    if (c.time) drawCursor(*painter, map, *c.time, false);
    if (c.hoverTime && shared_.figure.x.isTime && *c.hoverTime >= map.x.low && *c.hoverTime <= map.x.high) {
        const double x = std::round(map(*c.hoverTime, map.y.low).x()) + 0.5;
        painter->setPen(QPen(shared_.theme.line, 1));
        painter->drawLine(QPointF(x, map.rect.top()), QPointF(x, map.rect.bottom()));
    }
    if (c.box) {
        QColor tint = shared_.theme.accent;
        painter->setPen(QPen(tint, 1));
        tint.setAlphaF(0.12f);
        painter->setBrush(tint);
        painter->drawRect(c.box->translated(0.5, 0.5));
        painter->setBrush(Qt::NoBrush);
    }
    if (c.level) drawLevel(*painter, map);
    if (c.handle) drawHandle(*painter, map);
    if (!c.hoverText.isEmpty()) drawHover(*painter);
    if (c.hasFocus) {
        painter->setPen(QPen(shared_.theme.accent, 1, Qt::DotLine));
        painter->drawRect(map.rect.adjusted(-3.5, -3.5, 3.5, 3.5));
    }
}

void CursorLayer::drawCursor(QCPPainter& painter, const PixelMap& map, double t, bool isPinned) const {
    const Theme& theme = shared_.theme;
    if (shared_.figure.x.isTime) {
        if (t < map.x.low || t > map.x.high) return;
        const double x = std::round(map(t, map.y.low).x()) + 0.5;
        painter.setPen(QPen(theme.muted, 1, isPinned ? Qt::DashLine : Qt::SolidLine));
        painter.drawLine(QPointF(x, map.rect.top()), QPointF(x, map.rect.bottom()));
        if (!isPinned && shared_.cursors.pinned) {
            const QString text =
                QStringLiteral("Δt = ") + QString::fromStdString(shortNumber(t - *shared_.cursors.pinned, 4));
            const double width = QFontMetricsF(small(theme)).horizontalAdvance(text) + 12;
            const double left = x + 4 + width > map.rect.right() ? x - 4 - width : x + 4;
            drawPill(painter, {left, map.rect.bottom() - 20}, text, small(theme), theme.panel, theme.line,
                     theme.text);
        }
    }
    for (const Series& s : shared_.figure.series()) {
        if (!shared_.isShown(s) || (!shared_.figure.x.isTime && s.t.empty())) continue;
        const auto value = pointAt(s, t);
        if (!value) continue;
        const QPointF p = map(value->first, value->second);
        // A rectangle "contains" what is not a number.
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !map.rect.adjusted(-1, -1, 1, 1).contains(p))
            continue;
        painter.setPen(QPen(isPinned ? shared_.colorOf(s.style) : theme.panel, 1.2));
        painter.setBrush(isPinned ? theme.panel : shared_.colorOf(s.style));
        painter.drawEllipse(p, 3.6, 3.6);
    }
    painter.setBrush(Qt::NoBrush);
}

void CursorLayer::drawLevel(QCPPainter& painter, const PixelMap& map) const {
    const Theme& theme = shared_.theme;
    const double at = map(map.x.low, *shared_.cursors.level).y();
    if (!std::isfinite(at)) return;
    // Out of sight it stays at the edge, where it can be taken hold of.
    const double y = std::round(std::clamp(at, map.rect.top() + 2, map.rect.bottom() - 2)) + 0.5;
    painter.setPen(QPen(theme.accent, 1.5, y == std::round(at) + 0.5 ? Qt::SolidLine : Qt::DashLine));
    painter.drawLine(QPointF(map.rect.left(), y), QPointF(map.rect.right(), y));
    const QFont font = small(theme, QFont::DemiBold);
    const QSizeF size = QFontMetricsF(font).size(0, shared_.cursors.levelText);
    const double height = std::ceil(size.height()) + 4, width = std::ceil(size.width()) + 12;
    const double top = y - height - 4 < map.rect.top() ? y + 4 : y - height - 4;
    drawPill(painter, {map.rect.right() - width - 4, top}, shared_.cursors.levelText, font, theme.panel,
             theme.accent, theme.accent);
}

/// A ring, that shows what it is over.
void CursorLayer::drawHandle(QCPPainter& painter, const PixelMap& map) const {
    const QPointF at = map(shared_.cursors.handle->x(), shared_.cursors.handle->y());
    if (!std::isfinite(at.x()) || !std::isfinite(at.y()) || !map.rect.adjusted(-1, -1, 1, 1).contains(at))
        return;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(shared_.theme.panel, 4));
    painter.drawEllipse(at, 5.5, 5.5);
    painter.setPen(QPen(shared_.theme.accent, 1.8));
    painter.drawEllipse(at, 5.5, 5.5);
}

void CursorLayer::drawHover(QCPPainter& painter) const {
    const PlotCursors& c = shared_.cursors;
    painter.setPen(QPen(shared_.theme.panel, 1.2));
    painter.setBrush(c.hoverColor);
    if (c.hoverCell) {
        painter.setBrush(Qt::NoBrush);
        for (const auto& [color, width] :
             {std::pair{shared_.theme.panel, 3.5}, std::pair{shared_.theme.text, 1.5}}) {
            painter.setPen(QPen(color, width));
            painter.drawRect(*c.hoverCell);
        }
    } else {
        painter.drawEllipse(c.hoverPoint, 4, 4);
    }
    const QFont font = small(shared_.theme);
    const QRectF rect(shared_.plot.axisRect()->rect());
    const QSizeF size = QFontMetricsF(font).size(0, c.hoverText);
    const double width = size.width() + 12, height = size.height() + 4;
    const double x =
        std::clamp(c.hoverPoint.x() + 9, rect.left(), std::max(rect.left(), rect.right() - width));
    const double above = c.hoverPoint.y() - height - 8;
    drawPill(painter, {x, above < rect.top() ? c.hoverPoint.y() + 9 : above}, c.hoverText, font,
             shared_.theme.panel, shared_.theme.line, shared_.theme.text);
}

}  // namespace extremal
