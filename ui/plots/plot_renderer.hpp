// SPDX-License-Identifier: GPL-3.0-or-later
/// Figures without a window: into a painter, an image, a PDF or an SVG, of any size, in any theme. The same
/// bytes for the same figure, every time. Needs a QApplication, but no display (the offscreen platform will
/// do).
///
/// Sizes are in device-independent pixels (96 to the inch).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <QImage>
#include <QRectF>
#include <QSize>
#include <QString>

#include "engine/figure/figure.hpp"
#include "ui/base/theme.hpp"

class QPaintDevice;
class QPainter;

namespace extremal {

struct PlotOptions {
    bool hasHeader = true;         ///< title and subtitle above the plot
    bool hasLegend = true;         ///< line samples and names of the schemes
    bool isCard = false;           ///< rounded corners and a hairline around, for plots beside each other
    double padding = 12;           ///< around the plot
    int leftMargin = 0;            ///< of the axis on the left at least, for plots above each other to align
    std::optional<double> cursor;  ///< a time, marked
};

/// A painter that can draw figures, for pages made of several things. Draw anything else with painter().
class FigurePainter {
public:
    /// `isVector`: for PDF and SVG; curves keep more of their points.
    FigurePainter(QPaintDevice& device, bool isVector);
    ~FigurePainter();
    QPainter& painter();
    void draw(const Figure& figure, const QRectF& rect, const Theme& theme, const PlotOptions& options = {});
    /// The room that the axis on the left of a figure needs in a rectangle of this size.
    int leftMargin(const Figure& figure, const QSizeF& size, const Theme& theme, const PlotOptions& options);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The legend alone: line samples and names in one or more rows; returns the height used. With a null painter
/// it only measures.
double drawLegend(QPainter* painter, const QRectF& rect, const Figure& figure, const Theme& theme);

QImage renderFigure(const Figure& figure, QSize size, const Theme& theme, double scale = 1,
                    const PlotOptions& options = {});

/// A page whose content is drawn by a function, as the kind of file that the ending of its name says (.png,
/// .pdf, .svg). Returns what went wrong, empty if nothing did; the file appears whole or not at all.
using DrawPage = std::function<void(FigurePainter&, QRectF)>;
QString savePage(const QString& file, QSize size, double scale, const QString& title, const DrawPage& draw);

/// One figure as such a file.
QString saveFigure(const QString& file, const Figure& figure, QSize size, const Theme& theme,
                   double scale = 1, const PlotOptions& options = {});

}  // namespace extremal
