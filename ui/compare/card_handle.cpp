// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/card_handle.hpp"

#include <QMouseEvent>

#include <utility>

namespace extremal {

CardHandle::CardHandle(QWidget* parent, std::function<void(QPoint)> moved, std::function<void()> reset)
    : QWidget(parent), moved_(std::move(moved)), reset_(std::move(reset)) {
    setToolTip(tr("Drag to change the sizes; a double click gives them back"));
}

void CardHandle::setUpright(bool isUpright) { setCursor(isUpright ? Qt::SizeVerCursor : Qt::SizeHorCursor); }

void CardHandle::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
    grip_ = event->position().toPoint() - rect().center();
}

void CardHandle::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & Qt::LeftButton) moved_(mapToParent(event->position().toPoint()) - grip_);
}

void CardHandle::mouseDoubleClickEvent(QMouseEvent*) { reset_(); }

}  // namespace extremal
