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
            QPen pen(s.tone == Tone::pale ? theme.pale(style.color, paleLine) : style.color,
                     1.8 * theme.lineWidth, Qt::SolidLine, Qt::FlatCap);
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

namespace {

constexpr double headerGap = 4, leastWithLegend = 150;

/// The axis on the left has its own margin, which reaches into the padding.
int overhangOf(const PlotOptions& options) { return std::min(8, static_cast<int>(options.padding)); }

/// What header and legend leave of a rectangle.
QRectF insideOf(QRectF area, const Figure& figure, const Theme& theme, const PlotOptions& options) {
    area.adjust(options.padding, options.padding, -options.padding, -std::min(4.0, options.padding));
    if (options.hasHeader)
        area.setTop(area.top() + std::ceil(QFontMetricsF(theme.title()).height()) + headerGap);
    if (options.hasLegend && area.height() > leastWithLegend)
        area.setTop(area.top() + drawLegend(nullptr, area, figure, theme) + 2);
    return area;
}

QSize sizeInside(const QRectF& area, const PlotOptions& options) {
    return {static_cast<int>(area.width()) + overhangOf(options), static_cast<int>(area.height())};
}

void setUp(QCustomPlot& plot, FigurePlot& content, const Figure& figure, const PlotOptions& options) {
    plot.setBackground(Qt::NoBrush);
    QMargins margins = plot.axisRect()->minimumMargins();
    margins.setLeft(std::max(margins.left(), options.leftMargin));
    plot.axisRect()->setMinimumMargins(margins);
    content.setFigure(figure);
    content.setTime(options.cursor);
}

}  // namespace

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
    area = insideOf(area, figure, theme, options);
    double top = options.padding;
    const QRectF words(area.left(), top, area.width(), area.bottom() - top);
    if (options.hasHeader) top += drawHeader(painter, words, figure, theme) + headerGap;
    if (options.hasLegend && area.bottom() - top > leastWithLegend)
        drawLegend(&painter, QRectF(area.left(), top, area.width(), area.bottom() - top), figure, theme);
    if (const QSize size = sizeInside(area, options); size.width() > 40 && size.height() > 40) {
        QCustomPlot plot;
        FigurePlot content(plot, theme);
        setUp(plot, content, figure, options);
        content.setPrintDensity(impl_->isVector ? 4 : std::max(1.0, painter.transform().m11()));
        content.prepare(size);
        painter.translate(std::round(area.left()) - overhangOf(options), std::round(area.top()));
        plot.toPainter(&painter, size.width(), size.height());
    }
    painter.restore();
}

int FigurePainter::leftMargin(const Figure& figure, const QSizeF& size, const Theme& theme,
                              const PlotOptions& options) {
    const QSize inside = sizeInside(insideOf(QRectF(QPointF(0, 0), size), figure, theme, options), options);
    if (inside.width() <= 40 || inside.height() <= 40) return 0;
    QCustomPlot plot;
    FigurePlot content(plot, theme);
    setUp(plot, content, figure, options);
    content.prepare(inside);
    return plot.axisRect()->margins().left();
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
