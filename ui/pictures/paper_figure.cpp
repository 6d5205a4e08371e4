// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/pictures/paper_figure.hpp"

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/figure/image/palette.hpp"
#include "engine/figure/panels.hpp"
#include "ui/pictures/colour_sight.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal {
namespace {

constexpr double pixelsPerPoint = 96.0 / 72, pixelsPerMillimetre = 96 / 25.4;
constexpr double captionPixels = 11, curvePixels = 1.5;  // of the theme: tick labels and curves
constexpr double panelGap = 8, captionGap = 6, edge = 3;

Theme themeOf(const PaperStyle& style, double scale) {
    Theme theme = Theme::light();
    theme.family = fontFamily(style.font);
    theme.lineWidth = style.lines * pixelsPerPoint / scale / curvePixels;
    theme.text = theme.muted = QColor(Qt::black);
    theme.line = QColor("#50555C");
    theme.grid = QColor("#E6E8EB");
    if (style.colours == PaperColours::screen) return theme;
    std::copy(paperSeries.begin(), paperSeries.end(), theme.seriesColors.begin());
    if (style.colours == PaperColours::grey)
        for (QColor& colour : theme.seriesColors) colour = seenBy(Sight::grey, colour);
    return theme;
}

/// Where everything stands, in the pixels of the theme, which are `scale` pixels of the page each.
struct Layout {
    double scale = 1;
    Theme theme;
    std::vector<QRectF> panels;
    QRectF legend, caption;  ///< empty: there is none
    QSizeF size;             ///< of the whole
    Figure legendFigure;
};

/// Every scheme once, as its first curve is drawn.
Figure legendOf(const PaperFigure& paper) {
    Figure legend;
    for (const Figure& panel : paper.panels)
        for (const Series& s : panel.series()) {
            if (s.style < 0 || s.shade) continue;
            const auto all = legend.series();
            if (std::any_of(all.begin(), all.end(),
                            [&](const Series& other) { return other.label == s.label; }))
                continue;
            Series entry;
            entry.label = s.label;
            entry.style = s.style;
            entry.kind = s.kind;
            legend.add(std::move(entry));
        }
    return legend;
}

int columnsOf(const PaperFigure& paper, double width) {
    constexpr double least = 215;  // pixels of the theme
    const int count = std::max(1, static_cast<int>(paper.panels.size()));
    const int wanted = paper.style.columns > 0 ? paper.style.columns : static_cast<int>(width / least);
    return std::clamp(wanted, 1, count);
}

double heightOfText(const QFont& font, const QString& text, double width) {
    return std::ceil(QFontMetricsF(font)
                         .boundingRect(QRectF(0, 0, width, 1e6), Qt::TextWordWrap | Qt::AlignLeft, text)
                         .height());
}

double widthOfLegend(const Figure& legend, const Theme& theme) {
    constexpr double sample = 26, between = 6;  // as drawLegend has them
    double widest = 0;
    for (const Series& s : legend.series())
        widest = std::max(widest,
                          QFontMetricsF(theme.caption()).horizontalAdvance(QString::fromStdString(s.label)));
    return std::ceil(sample + between + widest) + 1;
}

Layout layOutPaper(const PaperFigure& paper) {
    Layout l;
    const PaperStyle& style = paper.style;
    l.scale = style.letters * pixelsPerPoint / captionPixels;
    l.theme = themeOf(style, l.scale);
    const double width = style.width * pixelsPerMillimetre / l.scale;
    l.legendFigure = legendOf(paper);
    const bool hasLegend = style.legend != LegendPlace::none && !l.legendFigure.series().empty();
    double top = 0, right = width;
    if (hasLegend && style.legend == LegendPlace::right) {
        const double room = std::min(widthOfLegend(l.legendFigure, l.theme), width / 2);
        right = width - room - panelGap;
        l.legend = QRectF(right + panelGap, 0, room, 1e6);
    } else if (hasLegend) {
        const QRectF room(edge, 0, width - 2 * edge, 1e6);
        l.legend = QRectF(room.left(), 0, room.width(), drawLegend(nullptr, room, l.legendFigure, l.theme));
        if (style.legend == LegendPlace::above) top = l.legend.height() + captionGap / 2;
    }
    const int columns = columnsOf(paper, right);
    const double panelWidth = (right - (columns - 1) * panelGap) / columns;
    const double panelHeight = panelWidth * style.ratio;
    double bottom = top;
    for (std::size_t i = 0; i < paper.panels.size(); ++i) {
        const double column = static_cast<double>(i % static_cast<std::size_t>(columns)),
                     row = static_cast<double>(i / static_cast<std::size_t>(columns));
        l.panels.emplace_back(column * (panelWidth + panelGap), top + row * (panelHeight + panelGap),
                              panelWidth, panelHeight);
        bottom = l.panels.back().bottom();
    }
    if (hasLegend && style.legend == LegendPlace::below) {
        l.legend.moveTop(bottom + captionGap);
        bottom = l.legend.bottom();
    }
    if (hasLegend && style.legend == LegendPlace::right) {
        l.legend.setHeight(drawLegend(nullptr, l.legend, l.legendFigure, l.theme));
        bottom = std::max(bottom, l.legend.bottom());
    }
    if (style.isCaptionDrawn) {
        const QString text = captionOf(paper);
        l.caption = QRectF(edge, bottom + captionGap, width - 2 * edge,
                           heightOfText(l.theme.body(), text, width - 2 * edge));
        bottom = l.caption.bottom();
    }
    l.size = QSizeF(width, std::ceil(bottom) + 1);
    return l;
}

Figure withLetter(Figure panel, std::size_t place, std::size_t count) {
    if (count < 2) return panel;
    const std::string letter = "(" + panelLetter(place).toStdString() + ")";
    panel.title = panel.title.empty() ? letter : letter + " " + panel.title;
    return panel;
}

void drawPaper(FigurePainter& figures, const PaperFigure& paper, const Layout& l) {
    QPainter& painter = figures.painter();
    painter.save();
    painter.scale(l.scale, l.scale);
    painter.fillRect(QRectF(QPointF(0, 0), l.size), Qt::white);
    PlotOptions options;
    options.hasLegend = false;
    options.padding = 2;
    std::vector<Figure> drawn;
    std::map<double, int> margins;  // of the panels above each other, by their left edge
    for (std::size_t i = 0; i < paper.panels.size(); ++i) {
        drawn.push_back(withLetter(paper.panels[i], i, paper.panels.size()));
        options.hasHeader = !drawn[i].title.empty();
        int& widest = margins[l.panels[i].left()];
        widest = std::max(widest, figures.leftMargin(drawn[i], l.panels[i].size(), l.theme, options));
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        options.hasHeader = !drawn[i].title.empty();
        options.leftMargin = margins[l.panels[i].left()];
        figures.draw(drawn[i], l.panels[i], l.theme, options);
    }
    if (!l.legend.isEmpty()) drawLegend(&painter, l.legend, l.legendFigure, l.theme);
    if (!l.caption.isEmpty()) {
        painter.setFont(l.theme.body());
        painter.setPen(l.theme.text);
        painter.drawText(l.caption, Qt::TextWordWrap | Qt::AlignLeft, captionOf(paper));
    }
    painter.restore();
}

}  // namespace

std::vector<Figure> panelsOf(std::span<const Figure> figures, const PaperStyle& style) {
    std::vector<Figure> panels;
    for (const Figure& whole : figures) {
        Figure figure = withSchemes(whole, style.schemes);
        if (style.times) figure = withinTimes(figure, style.times->first, style.times->second);
        figure.subtitle.clear();
        const bool isApart = style.portraits != Portraits::over && isPortrait(figure);
        if (style.isEqual && isPortrait(figure) && !figure.x.isLog && !figure.y.isLog)
            figure.aspect = Aspect::equal;
        if (!isApart) {
            if (!style.hasTitles) figure.title.clear();
            panels.push_back(std::move(figure));
            continue;
        }
        for (Figure& panel : besideEachOther(figure))
            panels.push_back(style.portraits == Portraits::density ? densityOf(panel) : std::move(panel));
    }
    return panels;
}

QSizeF paperSize(const PaperFigure& paper) {
    const Layout l = layOutPaper(paper);
    return l.size * l.scale;
}

QImage paperImage(const PaperFigure& paper, double dotsPerInch) {
    const Layout l = layOutPaper(paper);
    const double finer = dotsPerInch / 96;
    const QSizeF size = l.size * l.scale * finer;
    QImage image(std::max(1, static_cast<int>(std::lround(size.width()))),
                 std::max(1, static_cast<int>(std::lround(size.height()))), QImage::Format_RGB32);
    image.fill(Qt::white);
    FigurePainter painter(image, false);
    painter.painter().scale(finer, finer);
    drawPaper(painter, paper, l);
    return image;
}

QString savePaperPicture(const QString& file, const PaperFigure& paper) {
    const Layout l = layOutPaper(paper);
    return savePage(file, (l.size * l.scale).toSize(), paper.style.dotsPerInch / 96.0,
                    QString::fromStdString(paper.title),
                    [&](FigurePainter& painter, QRectF) { drawPaper(painter, paper, l); });
}

}  // namespace extremal
