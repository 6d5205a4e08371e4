// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure in a QCustomPlot: axes, ticks, series, marks, cursors. Used by the renderer (without a screen)
/// and by the widget (on it), so that both look the same.
///
/// The plot belongs to the caller and must outlive this object. Nothing is drawn before prepare().
#pragma once

#include <QSet>
#include <QSizeF>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "engine/figure/figure.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/polyline.hpp"
#include "ui/plots/view_state.hpp"

class QCustomPlot;

namespace extremal {

/// Times marked by vertical lines (on curves by dots), and what the pointer is over.
struct PlotCursors {
    std::optional<double> time, pinned, hoverTime;
    QString hoverText;   ///< empty: nothing is under the pointer
    QPointF hoverPoint;  ///< pixels
    QColor hoverColor;
    std::optional<QRectF> hoverCell;  ///< of a map: outlined in place of the point
    std::optional<double> level;      ///< a value of y marked by a line across, which the user moves
    QString levelText;                ///< beside that line
    std::optional<QPointF> handle;    ///< a point that the user drags, in the values of the axes
    std::optional<QRectF> box;        ///< the zoom box being drawn
    bool hasFocus = false;            ///< reached with the keyboard
};

class FigurePlot {
public:
    FigurePlot(QCustomPlot& plot, const Theme& theme);
    ~FigurePlot();
    FigurePlot(const FigurePlot&) = delete;
    FigurePlot& operator=(const FigurePlot&) = delete;

    void setTheme(const Theme& theme);
    void setFigure(Figure figure);
    /// Curves dimmed: a newer run is on its way. False if nothing changes.
    bool setStale(bool isStale);
    /// The time of the cursor, at which curves that move are drawn; without one at their last. False if none
    /// moves.
    bool setTime(std::optional<double> t);
    void setHidden(const QString& label, bool isHidden);
    /// Drawn thicker and on top; empty: none. False if nothing changes.
    bool setHighlighted(const QString& label);
    void setPrintDensity(double pointsPerPixel);

    const Figure& figure() const;
    bool isHidden(const QString& label) const;

    /// Sets ticks and ranges for a plot of this size; after any change, before drawing.
    void prepare(QSize size);

    ViewState& view();
    PlotCursors& cursors();
    PixelMap pixelMap() const;

    /// The visible series nearest to a pixel, at most `reach` away: its index in the figure and the row.
    struct Hit {
        std::size_t series = 0, row = 0;
        QPointF at;
    };
    std::optional<Hit> hit(QPointF pixel, double reach) const;

    struct Shared;  ///< what the drawn layers look at

private:
    bool moveCurves();

    std::unique_ptr<Shared> shared_;
};

}  // namespace extremal
