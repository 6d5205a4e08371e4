// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/scrub_label.hpp"

#include <QMouseEvent>

#include <cmath>

namespace extremal {
namespace {

constexpr double pixelsPerNotch = 5;
constexpr int anglePerNotch = 120;

}  // namespace

ScrubLabel::ScrubLabel(const QString& text, QWidget* parent) : QLabel(text, parent) {
    setCursor(Qt::SizeHorCursor);
}

void ScrubLabel::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return QLabel::mousePressEvent(event);
    pressedAt_ = event->position().x();
    done_ = 0;
    isDragged_ = false;
    event->ignore();  // the card behind takes the selection and the focus
}

void ScrubLabel::mouseMoveEvent(QMouseEvent* event) {
    if (!(event->buttons() & Qt::LeftButton)) return QLabel::mouseMoveEvent(event);
    const int notches = static_cast<int>(std::trunc((event->position().x() - pressedAt_) / pixelsPerNotch));
    if (notches == done_) return;
    isDragged_ = true;
    const int by = notches - done_;
    done_ = notches;
    emit scrubbed(by);
}

void ScrubLabel::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && !isDragged_ && rect().contains(event->position().toPoint()))
        emit clicked();
}

void ScrubLabel::wheelEvent(QWheelEvent* event) {
    if (!isTurnable_) return QLabel::wheelEvent(event);
    turning_ += event->angleDelta().y();
    const int notches = turning_ / anglePerNotch;
    turning_ -= notches * anglePerNotch;
    if (notches != 0) emit turned(notches);
    event->accept();
}

}  // namespace extremal
