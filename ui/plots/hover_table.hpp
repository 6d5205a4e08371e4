// SPDX-License-Identifier: GPL-3.0-or-later
/// What all schemes of a plot are at the time under the pointer, in a box beside it: t, a row per curve with
/// its value, and where a second cursor is pinned the difference to its value there. Between two samples the
/// value is on the straight line; where samples must not be joined it is that of the nearer one, which the
/// box says.
#pragma once

#include <QLabel>

#include <optional>
#include <string>

#include "engine/figure/figure.hpp"

namespace extremal {

struct Theme;

class HoverTable : public QLabel {
    Q_OBJECT
public:
    /// In the window of a plot, over everything in it.
    explicit HoverTable(QWidget* plot);
    /// `nearest`: the label of the scheme under the pointer, whose rows stand out.
    void show(const Figure& figure, double t, std::optional<double> pinned, const std::string& nearest,
              const Theme& theme);
    void placeBeside(QPoint pointer);  ///< in the window

private:
    QWidget* plot_;
};

/// The rows as rich text.
QString valuesAt(const Figure& figure, double t, std::optional<double> pinned, const std::string& nearest,
                 const Theme& theme);

}  // namespace extremal
