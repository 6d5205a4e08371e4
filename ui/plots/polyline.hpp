/// From the values of a series to what a screen can show of them: polylines in pixels, clipped and thinned.
///
/// NaN starts a new piece. Segments are clipped a little outside the plot, so that values of any size draw
/// with the right slope and no painter meets huge coordinates. Along a monotone x at most four points per
/// pixel column remain (first, lowest, highest, last: the picture is the same); on other curves points closer
/// than half a pixel are dropped, and more than that if they would still be more than 20,000.
#pragma once

#include <QPolygonF>
#include <QRectF>
#include <span>
#include <vector>

#include "ui/plots/view_state.hpp"

namespace extremal {

/// Values to pixels, y up.
struct PixelMap {
    PlotRange x, y;
    bool isXLog = false, isYLog = false;
    QRectF rect;
    QPointF operator()(double xValue, double yValue) const;
    double xAt(double pixel) const;
    double yAt(double pixel) const;
};

/// `density`: points per pixel that can be told apart (1 on a plain screen, more for print).
std::vector<QPolygonF> visiblePolylines(std::span<const double> x, std::span<const double> y,
                                        const PixelMap& map, bool isCurve, double density = 1);

}  // namespace extremal
