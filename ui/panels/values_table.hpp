// SPDX-License-Identifier: GPL-3.0-or-later
/// The values at the cursor: a row per scheme, a column per plot.
#pragma once

#include <QTableWidget>

#include <vector>

#include "engine/figure/figure.hpp"

namespace extremal {

struct Theme;

class ValuesTable : public QTableWidget {
    Q_OBJECT
public:
    explicit ValuesTable(QWidget* parent = nullptr);
    /// Values of the figures at t; only those against time or along a curve count.
    void show(const std::vector<const Figure*>& figures, double t, const Theme& theme);

    QSize sizeHint() const override;
};

}  // namespace extremal
