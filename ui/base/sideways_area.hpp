// SPDX-License-Identifier: GPL-3.0-or-later
/// Shows its content at full height where there is room for it, and scrolls it where it is too wide or too
/// high.
#pragma once

#include "ui/base/steady_scroll_area.hpp"

namespace extremal {

class SidewaysArea : public SteadyScrollArea {
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
