// SPDX-License-Identifier: GPL-3.0-or-later
/// The gap beside or below cards, which a hand takes to make them larger or smaller.
#pragma once

#include <QWidget>

#include <functional>

namespace extremal {

class CardHandle : public QWidget {
    Q_OBJECT
public:
    /// `moved`: with the place of the pointer in the parent; `reset`: after a double click.
    CardHandle(QWidget* parent, std::function<void(QPoint)> moved, std::function<void()> reset);
    /// Whether it moves up and down, or sideways.
    void setUpright(bool isUpright);

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

private:
    std::function<void(QPoint)> moved_;
    std::function<void()> reset_;
    QPoint grip_;  ///< of the pointer, from the middle
};

}  // namespace extremal
