// SPDX-License-Identifier: GPL-3.0-or-later
/// A curve that is drawn many times over itself, as an image: its cost is that of its pixels, not that of
/// Qt's stroker, which takes a tenth of a second for some ten thousand segments.
#pragma once

#include <QColor>
#include <QImage>
#include <QPolygonF>
#include <vector>

#include "ui/plots/polyline.hpp"

namespace extremal {

/// Lines of this width in the rectangle of the map, with smooth edges, for its top left corner. `density`:
/// device pixels per pixel.
QImage denseImage(const std::vector<QPolygonF>& lines, const PixelMap& map, const QColor& color, double width,
                  double density);

}  // namespace extremal
