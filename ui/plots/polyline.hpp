// SPDX-License-Identifier: GPL-3.0-or-later
/// From the values of a series to what a screen can show of them: lines in pixels, clipped and thinned, and
/// bands where a line goes up and down more often than pixels can tell apart.
///
/// NaN starts a new piece. Segments are clipped a little outside the plot, so that values of any size draw
/// with the right slope and no painter meets huge coordinates.
///
/// Along a monotone x at most four points per pixel column remain (first, lowest, highest, last: the picture
/// is the same). Where a line turns at least twice per three pixels, over some width and height, it becomes a
/// band between the extremes of each column: to draw it costs as much as a line of its width, not the sum of
/// its oscillations.
///
/// On other curves points closer than half a pixel are dropped, and more than that if they would still be
/// more than 20,000. A curve whose length fills a good part of the plot is dense: it is drawn without dashes,
/// and on a screen as an image (dense_curve.hpp).
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

/// What remains of a series.
struct VisibleLine {
    /// The extremes of a line from left to right, one point per pixel column each; upper on the screen.
    struct Band {
        QPolygonF upper, lower;
    };
    std::vector<QPolygonF> lines;
    std::vector<Band> bands;
    QPolygonF dots;        ///< of samples that are not joined
    bool isDense = false;  ///< a curve that is drawn many times over itself: dashes would not be seen
};

/// Of y over x, which is monotone. `density`: points per pixel that can be told apart (1 on a plain screen,
/// more for print).
VisibleLine visibleLine(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                        double density = 1);

/// Of a parametric curve.
VisibleLine visibleCurve(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                         double density = 1);

/// Of samples that must not be joined (Series::isSparse): dots, and along a monotone x bands where they are
/// many.
VisibleLine visibleSamples(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                           bool isCurve, double density = 1);

/// The length of all lines and edges of bands in pixels: what a painter has to stroke.
double strokedLength(const VisibleLine& visible);

}  // namespace extremal
