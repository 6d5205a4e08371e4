// SPDX-License-Identifier: GPL-3.0-or-later
/// The inside of PlotWidget; only for its sources.
#pragma once

#include <qcustomplot.h>

#include <QApplication>
#include <QPointer>
#include <QPushButton>
#include <QTimer>

#include <cmath>

#include "engine/figure/sample.hpp"
#include "ui/plots/figure_plot.hpp"
#include "ui/plots/hover_table.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/plots/replot_queue.hpp"

namespace extremal {

inline constexpr double hoverReach = 14, dragThreshold = 4, levelReach = 5, handleReach = 8;

inline double valueAtPixel(const PixelMap& map, PlotAxis axis, QPointF pixel) {
    const bool isX = axis == PlotAxis::x;
    const PlotRange r = isX ? map.x : map.y;
    const double f = isX ? (pixel.x() - map.rect.left()) / map.rect.width()
                         : (map.rect.bottom() - pixel.y()) / map.rect.height();
    const bool isLog = isX ? map.isXLog : map.isYLog;
    return isLog ? r.low * std::pow(r.high / r.low, f) : r.low + f * (r.high - r.low);
}

struct PlotWidget::Impl {
    QCustomPlot* plot;
    std::unique_ptr<FigurePlot> content;
    Theme theme;
    QPushButton* chip;
    QPointer<HoverTable> table;  ///< which lives in the window; of all values at the pointer
    enum class Drag { none, maybe, pan, box, level, handle } drag = Drag::none;
    QPointF press, last;
    int leftMargin = 0;
    bool isClickable = false;
    int clicks = 0;                    ///< that chose a place, or the second of a double click
    std::optional<PlotRange> awaited;  ///< the time range of the group, until there is a figure

    explicit Impl(const Theme& t) : theme(t) {}
    void replot() { queueReplot(*plot); }
    void replotCursor() { plot->layer("cursor")->replot(); }
    /// The cell of a map under a pixel.
    std::optional<HeatCell> cellAt(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        if (!map.rect.contains(pixel)) return {};
        return extremal::cellAt(content->figure(), valueAtPixel(map, PlotAxis::x, pixel),
                                valueAtPixel(map, PlotAxis::y, pixel));
    }
    QRectF rectOf(const HeatCell& cell) const {
        const HeatMap& heat = *content->figure().heat();
        const PixelMap map = content->pixelMap();
        const QPointF corner = map(heat.left, heat.bottom), opposite = map(heat.right, heat.top);
        const double width = (opposite.x() - corner.x()) / heat.columns,
                     height = (opposite.y() - corner.y()) / heat.rows;
        return QRectF(corner.x() + width * static_cast<double>(cell.column),
                      corner.y() + height * static_cast<double>(cell.row), width, height)
            .normalized();
    }
    /// The row of a study that a point stands for.
    std::optional<std::size_t> rowAt(QPointF pixel) const {
        const auto hit = content->hit(pixel, hoverReach);
        if (!hit) return {};
        const std::vector<std::size_t>& rows = content->figure().series()[hit->series].rows;
        return hit->row < rows.size() ? std::optional(rows[hit->row]) : std::nullopt;
    }
    bool isOnLevel(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const std::optional<double> level = content->cursors().level;
        if (!level || !map.rect.contains(pixel)) return false;
        const double y = map(map.x.low, *level).y();
        return std::abs(std::clamp(y, map.rect.top() + 2, map.rect.bottom() - 2) - pixel.y()) <= levelReach;
    }
    /// A double click fits the view, and chooses no place.
    void waitForSecondClick(QPointF place, PlotWidget& widget) {
        QTimer::singleShot(QApplication::doubleClickInterval(), &widget,
                           [this, place, &widget, n = ++clicks] {
                               if (n == clicks) emit widget.placeClicked(place.x(), place.y());
                           });
    }
    bool isOnHandle(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const std::optional<QPointF> handle = content->cursors().handle;
        if (!handle || !map.rect.contains(pixel)) return false;
        return QLineF(map(handle->x(), handle->y()), pixel).length() <= handleReach;
    }
    QPointF placeAt(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const QPointF inside(std::clamp(pixel.x(), map.rect.left(), map.rect.right()),
                             std::clamp(pixel.y(), map.rect.top(), map.rect.bottom()));
        return {valueAtPixel(map, PlotAxis::x, inside), valueAtPixel(map, PlotAxis::y, inside)};
    }
    bool isTime() const { return content->figure().x.isTime; }
    /// Whether a pixel lies on the x axis, the y axis, or (neither) in the plot.
    std::pair<bool, bool> axesAt(QPointF p) const {
        const QRectF r = plot->axisRect()->rect();
        if (p.y() > r.bottom()) return {true, false};
        if (p.x() < r.left()) return {false, true};
        return {true, true};
    }
};

}  // namespace extremal
