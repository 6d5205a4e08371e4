// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/dot_stamp.hpp"

#include <QPainter>

#include <cmath>

namespace extremal {

DotStamp::DotStamp(const QColor& color, double radius, double ratio)
    : ratio_(ratio), half_(static_cast<int>(std::ceil(radius * ratio)) + 1) {
    const int side = 2 * half_ + 1;
    for (int y = 0; y < places; ++y)
        for (int x = 0; x < places; ++x) {
            QPixmap picture(side, side);
            picture.fill(Qt::transparent);
            QPainter painter(&picture);
            painter.setRenderHint(QPainter::Antialiasing);
            painter.setPen(Qt::NoPen);
            painter.setBrush(color);
            painter.drawEllipse(QPointF(half_ + double(x) / places, half_ + double(y) / places),
                                radius * ratio, radius * ratio);
            painter.end();
            picture.setDevicePixelRatio(ratio);
            pictures_[static_cast<std::size_t>(y * places + x)] = std::move(picture);
        }
}

void DotStamp::draw(QPainter& painter, const QPointF& centre) const {
    const auto nearest = [&](double at) { return static_cast<int>(std::floor(at * ratio_ * places + 0.5)); };
    const int x = nearest(centre.x()), y = nearest(centre.y());
    const int inX = ((x % places) + places) % places, inY = ((y % places) + places) % places;
    painter.drawPixmap(QPointF((x - inX) / places - half_, (y - inY) / places - half_) / ratio_,
                       pictures_[static_cast<std::size_t>(inY * places + inX)]);
}

}  // namespace extremal
