// SPDX-License-Identifier: GPL-3.0-or-later
/// A slider that goes to where it is clicked, and can be dragged on from there.
#pragma once

#include <QSlider>

namespace extremal {

class SeekSlider : public QSlider {
    Q_OBJECT
public:
    using QSlider::QSlider;

protected:
    void mousePressEvent(QMouseEvent* event) override;
};

}  // namespace extremal
