// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_renderer.hpp"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

#include "engine/figure/sample.hpp"
#include "ui/plots/figure_plot.hpp"

namespace extremal {

struct FigurePainter::Impl {
    QCPPainter painter;
    bool isVector;
    Impl(QPaintDevice* device, bool vector) : painter(device), isVector(vector) {
        painter.setMode(QCPPainter::pmVectorized, vector);
        painter.setMode(QCPPainter::pmNoCaching, true);
        painter.setRenderHint(QPainter::Antialiasing, true);
        painter.setRenderHint(QPainter::TextAntialiasing, true);
    }
};

FigurePainter::FigurePainter(QPaintDevice& device, bool isVector) : impl_(new Impl(&device, isVector)) {}
FigurePainter::~FigurePainter() = default;
QPainter& FigurePainter::painter() { return impl_->painter; }

namespace {

constexpr double padding = 12;

double drawHeader(QPainter& painter, const QRectF& rect, const Figure& figure, const Theme& theme) {
    const QFontMetricsF titleMetrics(theme.title());
    const QString title =
        titleMetrics.elidedText(QString::fromStdString(figure.title), Qt::ElideRight, rect.width());
    const double base = rect.top() + titleMetrics.ascent();
    painter.setFont(theme.title());
    painter.setPen(theme.text);
    painter.drawText(QPointF(rect.left(), base), title);
    const double left = rect.left() + titleMetrics.horizontalAdvance(title) + 8;
    const double room = rect.right() - left;
    if (!figure.subtitle.empty() && room > 40) {
        painter.setFont(theme.caption());
        painter.setPen(theme.muted);
        painter.drawText(QPointF(left, base),
                         QFontMetricsF(theme.caption())
                             .elidedText(QString::fromStdString(figure.subtitle), Qt::ElideRight, room));
    }
    return std::ceil(titleMetrics.height());
}

/// Others are named by the title, in the plot itself, or by a scale of colours.
bool isInLegend(const Series& s) {
    return s.kind != SeriesKind::cells && s.kind != SeriesKind::ticks && s.style >= 0 && !s.shade;
}

}  // namespace

double drawLegend(QPainter* painter, const QRectF& rect, const Figure& figure, const Theme& theme) {
    const QFont font = theme.caption();
    const QFontMetricsF metrics(font);
    const double rowHeight = std::ceil(metrics.height()) + 3, sample = 26, gap = 6, space = 16;
    double x = rect.left(), y = rect.top();
    for (const Series& s : figure.series()) {
        if (!isInLegend(s)) continue;
        const QString label = metrics.elidedText(QString::fromStdString(seriesName(s)), Qt::ElideRight,
                                                 rect.width() - sample - gap);
        const double width = sample + gap + metrics.horizontalAdvance(label);
        if (x > rect.left() && x + width > rect.right()) {
            x = rect.left();
            y += rowHeight;
        }
        if (painter) {
            const SeriesStyle style = theme.series(s.style);
            QPen pen(s.tone == Tone::pale ? theme.pale(style.color, paleLine) : style.color, 1.8,
                     Qt::SolidLine, Qt::FlatCap);
            if (!style.dash.isEmpty()) pen.setDashPattern(style.dash);
            const double middle = y + metrics.height() / 2;
            if (hasLine(s.kind)) {
                painter->setPen(pen);
                painter->drawLine(QPointF(x, middle), QPointF(x + sample, middle));
            }
            if (hasMarks(s.kind)) {
                painter->setPen(Qt::NoPen);
                painter->setBrush(style.color);
                painter->drawEllipse(QPointF(x + sample / 2, middle), 4, 4);
                painter->setBrush(Qt::NoBrush);
            }
            painter->setFont(font);
            painter->setPen(theme.text);
            painter->drawText(QPointF(x + sample + gap, y + metrics.ascent()), label);
        }
        x += width + space;
    }
    const bool isNamed = std::any_of(figure.series().begin(), figure.series().end(),
                                     [](const Series& s) { return isInLegend(s); });
    return isNamed ? y + rowHeight - rect.top() : 0;
}

void FigurePainter::draw(const Figure& figure, const QRectF& rect, const Theme& theme,
                         const PlotOptions& options) {
    QCPPainter& painter = impl_->painter;
    painter.save();
    painter.translate(rect.topLeft());
    QRectF area(QPointF(0, 0), rect.size());
    if (options.isCard) {
        painter.setPen(QPen(theme.isDark ? theme.grid : theme.line.lighter(112), 1));
        painter.setBrush(theme.panel);
        painter.drawRoundedRect(area.adjusted(0.5, 0.5, -0.5, -0.5), 8, 8);
        painter.setBrush(Qt::NoBrush);
    } else {
        painter.fillRect(area, theme.panel);
    }
    area.adjust(padding, padding, -padding, -4);
    if (options.hasHeader) area.setTop(area.top() + drawHeader(painter, area, figure, theme) + 4);
    if (options.hasLegend && area.height() > 150)
        area.setTop(area.top() + drawLegend(&painter, area, figure, theme) + 2);

    const QSize size(static_cast<int>(area.width()) + 8, static_cast<int>(area.height()));
    if (size.width() > 40 && size.height() > 40) {
        QCustomPlot plot;
        FigurePlot content(plot, theme);
        plot.setBackground(Qt::NoBrush);
        content.setPrintDensity(impl_->isVector ? 4 : std::max(1.0, painter.transform().m11()));
        content.setFigure(figure);
        content.cursors().time = options.cursor;
        content.prepare(size);
        painter.translate(std::round(area.left()) - 8, std::round(area.top()));
        plot.toPainter(&painter, size.width(), size.height());
    }
    painter.restore();
}

QImage renderFigure(const Figure& figure, QSize size, const Theme& theme, double scale,
                    const PlotOptions& options) {
    QImage image(QSize(static_cast<int>(std::lround(size.width() * scale)),
                       static_cast<int>(std::lround(size.height() * scale))),
                 QImage::Format_ARGB32_Premultiplied);
    image.fill(options.isCard ? theme.window : theme.panel);
    FigurePainter painter(image, false);
    painter.painter().scale(scale, scale);
    painter.draw(figure, QRectF(QPointF(0, 0), QSizeF(size)), theme, options);
    return image;
}

QString saveFigure(const QString& file, const Figure& figure, QSize size, const Theme& theme, double scale,
                   const PlotOptions& options) {
    return savePage(file, size, scale, QString::fromStdString(figure.title),
                    [&](FigurePainter& painter, QRectF page) {
                        painter.painter().fillRect(page, options.isCard ? theme.window : theme.panel);
                        painter.draw(figure, page, theme, options);
                    });
}

}  // namespace extremal
