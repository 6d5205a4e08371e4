// SPDX-License-Identifier: GPL-3.0-or-later
/// Shows its content at full height where there is room for it, and scrolls it where it is too wide or too
/// high.
#pragma once

#include <QScrollArea>

namespace extremal {

class SidewaysArea : public QScrollArea {
public:
    explicit SidewaysArea(QWidget* parent = nullptr);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    int contentHeight() const;
};

}  // namespace extremal
