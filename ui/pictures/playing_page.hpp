// SPDX-License-Identifier: GPL-3.0-or-later
/// What moves on a page for browsers: the stage as a film, and the time in the plots. No server is needed and
/// nothing is loaded: pictures are in the page.
///
/// The one script of a page is the constant text of playScript(). The policy of the page admits a script
/// of this fingerprint and no other, so that a text of a scene could not become active even where it were
/// written into the page as it is. From the page the script reads numbers alone.
#pragma once

#include <QImage>
#include <QString>

#include <memory>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// The stage at evenly spaced times from the start to the end of the results.
struct Film {
    std::vector<double> times;   ///< one per frame; empty: nothing moves
    std::vector<QImage> frames;  ///< of the stage; empty: it has none, or cannot be drawn here
    QString unit;                ///< of the times
};

/// Draws it, in any thread; takes some hundredths of a second per frame.
Film filmOf(const std::shared_ptr<const Comparison>& comparison, int count);

/// The bar with its button and its slider, and the film above it; empty where nothing moves.
QString filmHtml(const Film& film);

/// A plot (SVG of this size), with a line at the time of each frame, or where x is not the time a dot on each
/// curve. Without times it stands still.
QString movingFigureHtml(const Figure& figure, int width, int height, const Film& film);

/// The script, and the policy of the page that admits it alone.
QString playScript();
QString pagePolicy();
/// Rules of style for the parts above.
QString playStyle();

}  // namespace extremal
