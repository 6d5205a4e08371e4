// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/sideways_area.hpp"

#include <QResizeEvent>
#include <QScrollBar>

#include <algorithm>

namespace extremal {

SidewaysArea::SidewaysArea(QWidget* parent) : SteadyScrollArea(parent) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    setFocusPolicy(Qt::NoFocus);
}

int SidewaysArea::contentHeight() const {
    if (!widget()) return 0;
    const bool isCut = widget()->minimumSizeHint().width() > width();
    return widget()->sizeHint().height() + (isCut ? horizontalScrollBar()->sizeHint().height() : 0);
}

QSize SidewaysArea::sizeHint() const {
    return {widget() ? widget()->sizeHint().width() : 0, contentHeight()};
}

QSize SidewaysArea::minimumSizeHint() const {
    constexpr int some = 120;  // rows that tell what it is
    return {0, std::min(some, contentHeight())};
}

bool SidewaysArea::eventFilter(QObject* watched, QEvent* event) {
    if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return SteadyScrollArea::eventFilter(watched, event);
}

void SidewaysArea::resizeEvent(QResizeEvent* event) {
    QScrollArea::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) updateGeometry();
}

}  // namespace extremal
