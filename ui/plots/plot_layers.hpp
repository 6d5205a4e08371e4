// SPDX-License-Identifier: GPL-3.0-or-later
/// The things a FigurePlot puts on the layers of its QCustomPlot. Only for the sources of ui/plots: it
/// includes QCustomPlot.
#pragma once

#include <qcustomplot.h>

#include "ui/plots/figure_plot.hpp"

namespace extremal {

struct FigurePlot::Shared {
    QCustomPlot& plot;
    Theme theme;
    Figure figure;
    ViewState view;
    PlotCursors cursors;
    QSet<QString> hidden;
    QString highlighted;
    bool isStale = false;
    double density = 1;
    bool isTitleAbove = false;  ///< of the y axis: above the plot, where there is no room beside it
    /// Of a heat map without a scale: made when it is drawn for the first time, and null before that, and
    /// after another figure or theme.
    mutable QImage fadedCells = {};

    PixelMap map() const;
    bool isShown(const Series& s) const { return !hidden.contains(QString::fromStdString(s.label)); }
    /// Titles with lowered parts, which the axes cannot draw.
    bool hasOwnTitles() const;
    /// Another scheme is highlighted, and has curves here.
    bool isFaded(const Series& s) const;
    QColor colorOf(int style) const;
    QColor shaded(double shade) const;    ///< of the figure's ColourScale
    QColor mixed(const QColor& c) const;  ///< of results that are stale
};

/// Floor, doubtful band, guides and labels below the curves, curves, then marks of failures and the message
/// above them.
class CurvesLayer : public QCPLayerable {
public:
    explicit CurvesLayer(const FigurePlot::Shared& shared);

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
    QRect clipRect() const override { return shared_.plot.axisRect()->rect().adjusted(0, 0, 1, 1); }
    void draw(QCPPainter* painter) override;

private:
    void drawHeat(QCPPainter& painter, const PixelMap& map) const;
    void drawFloor(QCPPainter& painter, const PixelMap& map) const;
    double hiddenBy(const QRectF& box, const PixelMap& map) const;
    void drawKey(QCPPainter& painter, const PixelMap& map) const;
    void drawAreas(QCPPainter& painter, const PixelMap& map) const;
    void drawGuides(QCPPainter& painter, const PixelMap& map) const;
    void drawSeries(QCPPainter& painter, const PixelMap& map, const Series& series) const;
    void drawCells(QCPPainter& painter, const PixelMap& map, const Series& series) const;
    void drawMarks(QCPPainter& painter, const PixelMap& map, const Series& series, const QColor& color) const;
    const FigurePlot::Shared& shared_;
    std::size_t dots_ = 0;  ///< of clouds, in sight
};

class MarksLayer : public QCPLayerable {
public:
    explicit MarksLayer(const FigurePlot::Shared& shared);

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
    QRect clipRect() const override {
        QRect rect = shared_.plot.axisRect()->rect().adjusted(-8, -8, 8, 8);
        if (shared_.hasOwnTitles()) return shared_.plot.viewport();
        if (shared_.isTitleAbove) rect.setTopLeft(shared_.plot.viewport().topLeft());
        return shared_.figure.heat() || shared_.figure.find<ColourScale>()
                   ? rect.adjusted(0, 0, shared_.plot.axisRect()->margins().right(), 0)
                   : rect;
    }
    void draw(QCPPainter* painter) override;

private:
    void drawTitleAbove(QCPPainter& painter, const PixelMap& map) const;
    void drawEvents(QCPPainter& painter, const PixelMap& map) const;
    void drawFailures(QCPPainter& painter, const PixelMap& map) const;
    std::optional<QPointF> endOfCurve(const std::string& label, const PixelMap& map) const;
    const FigurePlot::Shared& shared_;
};

/// Cursor lines and dots, hover text, zoom box: on a buffered layer of its own.
class CursorLayer : public QCPLayerable {
public:
    explicit CursorLayer(const FigurePlot::Shared& shared);

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
    QRect clipRect() const override { return shared_.plot.axisRect()->rect().adjusted(-6, -6, 6, 6); }
    void draw(QCPPainter* painter) override;

private:
    void drawCursor(QCPPainter& painter, const PixelMap& map, double t, bool isPinned) const;
    void drawHover(QCPPainter& painter) const;
    void drawLevel(QCPPainter& painter, const PixelMap& map) const;
    void drawHandle(QCPPainter& painter, const PixelMap& map) const;
    const FigurePlot::Shared& shared_;
};

}  // namespace extremal
