// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/snapshot_page.hpp"

#include <QFontMetricsF>
#include <QImage>
#include <QPainter>

#include <algorithm>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/stage/stage_overlay.hpp"
#include "ui/stage/stage_picture.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {
namespace {

constexpr double margin = 14, gap = 10, padding = 12;

/// Title and muted subtitle on one baseline; returns the height used.
double drawTitle(QPainter& painter, const QRectF& rect, const QFont& font, const QString& title,
                 const QString& subtitle, const Theme& theme) {
    const QFontMetricsF metrics(font), small(theme.caption());
    const double base = rect.top() + metrics.ascent();
    const QString shown = metrics.elidedText(title, Qt::ElideRight, rect.width());
    painter.setFont(font);
    painter.setPen(theme.text);
    painter.drawText(QPointF(rect.left(), base), shown);
    const double left = rect.left() + metrics.horizontalAdvance(shown) + 10;
    if (!subtitle.isEmpty() && rect.right() - left > 40) {
        painter.setFont(theme.caption());
        painter.setPen(theme.muted);
        painter.drawText(QPointF(left, base),
                         small.elidedText(subtitle, Qt::ElideRight, rect.right() - left));
    }
    return std::ceil(metrics.height());
}

/// Every scheme of the comparison, for the legend of the whole page.
Figure legendOf(const Comparison& comparison) {
    Figure figure;
    for (const auto& scheme : comparison.schemes) {
        Series series;
        series.label = scheme->spec.label;
        series.style = scheme->style;
        figure.add(std::move(series));
    }
    return figure;
}

/// The picture of the stage in `area`, pixel for pixel on raster devices.
void drawStagePicture(QPainter& painter, const QRectF& area, double scale, const StagePlayer& player,
                      const SnapshotPage& page, const Theme& theme, const OverlayOptions& overlay) {
    const double finer = page.isVector ? 2 : 1;
    const double left = std::round(area.left() * scale), top = std::round(area.top() * scale);
    const double width = std::floor(area.right() * scale) - left,
                 height = std::floor(area.bottom() * scale) - top;
    if (width < 8 || height < 8) return;
    const StageFrame frame = player.frame(page.time, stageStyle(theme));
    const Camera camera = player.fittedCamera(width / scale, height / scale, stageMargin);
    QImage image = drawStage(frame, camera, QSizeF(width / scale, height / scale), scale * finer);
    image.setDevicePixelRatio(1);
    painter.save();
    painter.scale(1 / scale, 1 / scale);
    painter.drawImage(QRectF(left, top, width, height), image);
    painter.restore();
    OverlayOptions options = overlay;
    options.camera = camera;
    paintOverlay(painter, area, frame, player, theme, options);
}

void drawStageCard(QPainter& painter, const QRectF& place, double scale, const StagePlayer& player,
                   const SnapshotPage& page, const Theme& theme) {
    if (page.isSingle) {
        painter.fillRect(place, theme.panel);
    } else {
        painter.setPen(QPen(theme.isDark ? theme.grid : theme.line.lighter(112), 1));
        painter.setBrush(theme.panel);
        painter.drawRoundedRect(place.adjusted(0.5, 0.5, -0.5, -0.5), 8, 8);
        painter.setBrush(Qt::NoBrush);
    }
    QRectF area = place.adjusted(padding, padding, -padding, -4);
    if (area.height() > 110) {
        const QString subtitle =
            page.isSingle ? QString::fromStdString(page.comparison->scene.title) : QString();
        area.setTop(area.top() +
                    drawTitle(painter, area, theme.title(), QStringLiteral("Stage"), subtitle, theme));
    }
    drawStagePicture(painter, area.adjusted(-6, 2, 6, 0), scale, player, page, theme, {page.isSingle});
}

}  // namespace

double pageScale(const SnapshotPage& page, int width, int height) {
    const double ratio =
        page.isSingle ? std::min(width / 840.0, height / 560.0) : std::min(width / 1200.0, height / 800.0);
    return std::max(ratio, 0.75);
}

std::vector<QRectF> cardPlaces(QRectF area, std::size_t count, double between) {
    if (count == 0) return {};
    std::size_t columns = 1;
    double best = 1e300;
    for (std::size_t c = 1; c <= std::min<std::size_t>(count, 6); ++c) {
        const std::size_t rows = (count + c - 1) / c;
        if (c * rows >= count + c) continue;
        const double w = (area.width() + between) / static_cast<double>(c) - between;
        const double h = (area.height() + between) / static_cast<double>(rows) - between;
        const double emptiness = static_cast<double>(c * rows - count) / static_cast<double>(c * rows);
        const double badness = w > 0 && h > 0 ? std::abs(std::log(w / h / 1.6)) + emptiness : 1e200;
        if (badness < best) {
            best = badness;
            columns = c;
        }
    }
    const std::size_t rows = (count + columns - 1) / columns;
    const std::size_t spare = columns * rows - count;  // the first card takes them
    const double w = (area.width() + between) / static_cast<double>(columns);
    const double h = (area.height() + between) / static_cast<double>(rows);
    std::vector<QRectF> places;
    for (std::size_t i = 0, cell = 0; i < count; ++i) {
        const std::size_t span = i == 0 ? 1 + spare : 1;
        // Whole pixels, so that hairlines are sharp.
        const double x0 = std::round(area.left() + w * static_cast<double>(cell % columns));
        const double x1 = std::round(area.left() + w * static_cast<double>(cell % columns + span) - between);
        const double y0 = std::round(area.top() + h * static_cast<double>(cell / columns));
        const double y1 = std::round(area.top() + h * static_cast<double>(cell / columns + 1) - between);
        places.emplace_back(QPointF(x0, y0), QPointF(std::max(x1, x0 + 1), std::max(y1, y0 + 1)));
        cell += span;
    }
    return places;
}

void drawSnapshotPage(FigurePainter& figures, QRectF pixels, const SnapshotPage& page, const Theme& theme) {
    QPainter& painter = figures.painter();
    const double scale = pageScale(page, static_cast<int>(pixels.width()), static_cast<int>(pixels.height()));
    painter.fillRect(pixels, page.isSingle ? theme.panel : theme.window);
    painter.save();
    painter.scale(scale, scale);
    const QRectF whole(QPointF(0, 0), pixels.size() / scale);
    QRectF area = whole;
    if (!page.isSingle) {
        const bool isSmall = whole.height() < 300;
        area.adjust(isSmall ? 4 : margin, isSmall ? 4 : margin, isSmall ? -4 : -margin,
                    isSmall ? -4 : -margin);
        if (!isSmall) {
            const Scene& scene = page.comparison->scene;
            area.setTop(area.top() + 2 +
                        drawTitle(painter, area, theme.heading(), QString::fromStdString(scene.title),
                                  QString::fromStdString(scene.source), theme));
            area.setTop(area.top() + 6 +
                        drawLegend(&painter, area.adjusted(0, 6, 0, 0), legendOf(*page.comparison), theme));
            area.setTop(area.top() + 6);
        }
    }
    const auto places = page.isSingle ? std::vector<QRectF>{area} : cardPlaces(area, page.views.size(), gap);
    PlotOptions options;
    options.isCard = !page.isSingle;
    options.hasLegend = page.isSingle;
    options.cursor = page.cursor;
    for (std::size_t i = 0; i < page.views.size() && i < places.size(); ++i) {
        if (page.views[i].id == "stage")
            drawStageCard(painter, places[i], scale, StagePlayer(page.comparison), page, theme);
        else
            figures.draw(makeFigure(*page.comparison, page.views[i]), places[i], theme, options);
    }
    painter.restore();
}

}  // namespace extremal
