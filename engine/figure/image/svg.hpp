// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure as an SVG picture, for notebooks and pages: no window, no font and no script is needed. It shows
/// every layer of the figure; the plots of the window and of `extremal snapshot` are drawn by ui/plots, which
/// also knows cursors and hovering.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "engine/figure/figure.hpp"

namespace extremal {

struct SvgOptions {
    int width = 640, height = 400;  ///< pixels, with the legend; at least 160 x 120
    bool isDark = false;
};

std::string svgOf(const Figure& figure, const SvgOptions& options = {});

/// The rectangle of the axes in that picture, in its pixels from the left and the top, and where values are.
struct SvgFrame {
    double left = 0, right = 0, top = 0, bottom = 0;
    std::pair<double, double> x, y;  ///< the values at the left and right, and at the lower and upper edge
    bool isXLog = false, isYLog = false;
    /// Empty outside the axes; without y the height is that of the upper edge.
    std::optional<std::pair<double, double>> at(double xValue, std::optional<double> yValue) const;
};
SvgFrame svgFrame(const Figure& figure, const SvgOptions& options = {});

}  // namespace extremal
