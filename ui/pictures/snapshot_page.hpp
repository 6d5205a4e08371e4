// SPDX-License-Identifier: GPL-3.0-or-later
/// The page of a snapshot: a heading, a legend, and the stage and the plots as cards in a grid.
#pragma once

#include <QRectF>

#include <memory>
#include <optional>
#include <vector>

#include "engine/run/comparison.hpp"

namespace extremal {

class FigurePainter;
struct Theme;

struct SnapshotPage {
    std::shared_ptr<const Comparison> comparison;
    std::vector<View> views;       ///< "stage" among them or not
    double time = 0;               ///< what the stage shows
    std::optional<double> cursor;  ///< a time marked in the plots
    bool isSingle = false;         ///< one view fills the page
    bool isVector = false;         ///< the stage is embedded with more pixels
};

/// Device pixels per logical pixel: letters keep their share of large pictures, and their size in small ones.
double pageScale(const SnapshotPage& page, int width, int height);

/// The places of `count` cards in `area`, the first one wider where the grid has room to spare.
std::vector<QRectF> cardPlaces(QRectF area, std::size_t count, double gap);

/// Throws OpenGlUnavailable if the stage is to be drawn and cannot be.
void drawSnapshotPage(FigurePainter& painter, QRectF pixels, const SnapshotPage& page, const Theme& theme);

}  // namespace extremal
