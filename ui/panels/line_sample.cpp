// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/line_sample.hpp"

#include <QPainter>

#include "ui/base/theme.hpp"

namespace extremal {

void drawLineSample(QPainter& painter, const QRectF& box, const Theme& theme, int style, bool isOn) {
    painter.setRenderHint(QPainter::Antialiasing);
    const SeriesStyle series = theme.series(style);
    QPen pen(isOn ? series.color : theme.line, 2);
    pen.setCapStyle(Qt::FlatCap);
    if (!series.dash.isEmpty()) pen.setDashPattern(series.dash);
    painter.setPen(pen);
    painter.drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()));
}

LineSample::LineSample(QWidget* parent) : QAbstractButton(parent) {
    setFixedSize(sizeHint());
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::TabFocus);
}

void LineSample::show(const Theme& theme, int style, bool isOn) {
    theme_ = &theme;
    style_ = style;
    isOn_ = isOn;
    update();
}

void LineSample::paintEvent(QPaintEvent*) {
    if (!theme_) return;
    QPainter painter(this);
    drawLineSample(painter, QRectF(rect()).adjusted(0, 0, -2, 0), *theme_, style_, isOn_);
    if (hasFocus() || underMouse()) {
        painter.setPen(QPen(theme_->accent, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(rect()).adjusted(-1, 0.5, -0.5, -0.5), 4, 4);
    }
}

}  // namespace extremal
