// SPDX-License-Identifier: GPL-3.0-or-later
/// Heat maps: their cells, and the scale in the right margin of the plot where there is one; and the scale of
/// the colours of series.
#pragma once

#include "ui/plots/plot_layers.hpp"

namespace extremal {

/// The room that the scale needs to the right of the plot; 0 without one.
int scaleWidth(const Figure& figure, const Theme& theme);

/// One pixel a cell of a heat map without a scale, from the ground of the plot at `low` to full colour at
/// `high`.
QImage fadedCells(const HeatMap& heat, const Theme& theme);

void drawMapCells(QCPPainter& painter, const PixelMap& map, const FigurePlot::Shared& shared);
void drawColourScale(QCPPainter& painter, const PixelMap& map, const Theme& theme, const ColourScale& scale);
void drawMapScale(QCPPainter& painter, const PixelMap& map, const FigurePlot::Shared& shared);

}  // namespace extremal
