#include "ui/panels/line_sample.hpp"

#include <QPainter>

#include "ui/shell/theme.hpp"

namespace extremal {

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
    painter.setRenderHint(QPainter::Antialiasing);
    const SeriesStyle series = theme_->series(style_);
    QPen pen(isOn_ ? series.color : theme_->line, 2);
    pen.setCapStyle(Qt::FlatCap);
    if (!series.dash.isEmpty()) pen.setDashPattern(series.dash);
    painter.setPen(pen);
    const double y = height() / 2.0;
    painter.drawLine(QPointF(0, y), QPointF(width() - 2, y));
    if (hasFocus() || underMouse()) {
        painter.setPen(QPen(theme_->accent, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(rect()).adjusted(-1, 0.5, -0.5, -0.5), 4, 4);
    }
}

}  // namespace extremal
