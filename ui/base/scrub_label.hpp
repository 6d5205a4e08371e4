// SPDX-License-Identifier: GPL-3.0-or-later
/// A label of a number that the mouse changes: dragged sideways, or turned with the wheel where that is
/// allowed. A click without a drag opens what the number is typed into.
#pragma once

#include <QLabel>

namespace extremal {

class ScrubLabel : public QLabel {
    Q_OBJECT
public:
    explicit ScrubLabel(const QString& text = {}, QWidget* parent = nullptr);
    /// Off at first, so that scrolling over the label does not change the number.
    void setTurnable(bool isTurnable) { isTurnable_ = isTurnable; }

signals:
    void clicked();
    void scrubbed(int notches);  ///< to the right is more
    void turned(int notches);    ///< of the wheel

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

private:
    bool isTurnable_ = false, isDragged_ = false;
    double pressedAt_ = 0;
    int done_ = 0;     ///< notches of this drag
    int turning_ = 0;  ///< angle that has not made a notch yet
};

}  // namespace extremal
