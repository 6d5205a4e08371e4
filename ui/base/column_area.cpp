// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/column_area.hpp"

#include <QEvent>
#include <QScrollBar>

#include <algorithm>

namespace extremal {

ColumnArea::ColumnArea(QWidget* parent) : SteadyScrollArea(parent) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
}

void ColumnArea::setLimits(int least, int most) {
    least_ = least;
    most_ = std::max(least, most);
    updateGeometry();
}

QSize ColumnArea::minimumSizeHint() const {
    // With room for the bar, so that a column that grows higher does not become wider.
    const int wanted =
        widget() ? widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width() : 0;
    return {std::clamp(wanted, least_, most_), QScrollArea::minimumSizeHint().height()};
}

bool ColumnArea::eventFilter(QObject* watched, QEvent* event) {
    if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return SteadyScrollArea::eventFilter(watched, event);
}

}  // namespace extremal
