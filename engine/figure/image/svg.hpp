// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure as an SVG picture, for notebooks and pages: no window, no font and no script is needed. It shows
/// every layer of the figure; the plots of the window and of `extremal snapshot` are drawn by ui/plots, which
/// also knows cursors and hovering.
#pragma once

#include <string>

#include "engine/figure/figure.hpp"

namespace extremal {

struct SvgOptions {
    int width = 640, height = 400;  ///< pixels, with the legend; at least 160 x 120
    bool isDark = false;
};

std::string svgOf(const Figure& figure, const SvgOptions& options = {});

}  // namespace extremal
