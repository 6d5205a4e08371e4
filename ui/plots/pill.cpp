// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/pill.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

QFont small(const Theme& theme, QFont::Weight weight) {
    QFont font = theme.caption();
    font.setPixelSize(std::max(6, font.pixelSize() - 1));
    font.setWeight(weight);
    return font;
}

QRectF drawPill(QCPPainter& painter, QPointF topLeft, const QString& text, const QFont& font,
                const QColor& ground, const QColor& line, const QColor& color) {
    const QSizeF size = QFontMetricsF(font).size(0, text);
    const QRectF box(topLeft.x(), topLeft.y(), std::ceil(size.width()) + 12, std::ceil(size.height()) + 4);
    painter.setPen(QPen(line, 1));
    painter.setBrush(ground);
    painter.drawRoundedRect(box.translated(0.5, 0.5), 4, 4);
    painter.setBrush(Qt::NoBrush);
    painter.setFont(font);
    painter.setPen(color);
    painter.drawText(box, Qt::AlignCenter, text);
    return box;
}

}  // namespace extremal
