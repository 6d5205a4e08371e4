// SPDX-License-Identifier: GPL-3.0-or-later
/// Scrolls a column up and down, and is as wide as the column asks for within two limits; where that is not
/// enough, it scrolls sideways too.
#pragma once

#include "ui/base/steady_scroll_area.hpp"

namespace extremal {

class ColumnArea : public SteadyScrollArea {
public:
    explicit ColumnArea(QWidget* parent = nullptr);
    /// Limits of its width, in pixels.
    void setLimits(int least, int most);
    QSize minimumSizeHint() const override;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    int least_ = 0, most_ = QWIDGETSIZE_MAX;
};

}  // namespace extremal
