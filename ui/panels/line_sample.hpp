// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme's line: its colour and dash, as in every plot. As a button it switches the scheme on and off.
#pragma once

#include <QAbstractButton>
#include <QRectF>

class QPainter;

namespace extremal {

struct Theme;

/// The line across the middle of a box, grey if the scheme is off.
void drawLineSample(QPainter& painter, const QRectF& box, const Theme& theme, int style, bool isOn);

class LineSample : public QAbstractButton {
    Q_OBJECT
public:
    explicit LineSample(QWidget* parent = nullptr);
    void show(const Theme& theme, int style, bool isOn);
    QSize sizeHint() const override { return {30, 18}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    const Theme* theme_ = nullptr;
    int style_ = 0;
    bool isOn_ = true;
};

}  // namespace extremal
