// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/map_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/image/faded_cell.hpp"
#include "ui/plots/axis_title.hpp"
#include "ui/plots/tickers.hpp"
#include "ui/plots/value_colour.hpp"

namespace extremal {
namespace {

constexpr double barLeft = 10, barWidth = 10, tickLength = 3;

QFont scaleFont(const Theme& theme) {
    QFont font = theme.caption();
    font.setPixelSize(std::max(6, font.pixelSize() - 1));
    return font;
}

/// What a cell without a value, or beside its value, is marked with.
enum class Fault { none, drifting, failed, blowUp };
Fault faultOf(const std::string& text) {
    return text.empty()         ? Fault::none
           : text == "drifting" ? Fault::drifting
           : text == "blow-up"  ? Fault::blowUp
                                : Fault::failed;
}
QString nameOf(Fault fault) {
    return fault == Fault::blowUp   ? QStringLiteral("blow-up")
           : fault == Fault::failed ? QStringLiteral("failed")
                                    : QStringLiteral("drifting");
}

/// Off the scale: plain where the state grew without bounds, hatched where there was no next step. Over its
/// colour: dots where the energy drifts.
void fillFault(QCPPainter& painter, const QRectF& rect, const Theme& theme, Fault fault) {
    if (fault == Fault::drifting) return painter.fillRect(rect, QBrush(theme.panel, Qt::Dense6Pattern));
    painter.fillRect(rect, fault == Fault::blowUp ? theme.errorLine : theme.errorGround);
    if (fault == Fault::failed) painter.fillRect(rect, QBrush(theme.errorLine, Qt::BDiagPattern));
}

/// Decades with a word, every n-th where there is little room.
std::vector<int> decadesOf(const HeatMap& heat, double height, double each) {
    const int low = static_cast<int>(std::lround(std::log10(heat.low))),
              high = static_cast<int>(std::lround(std::log10(heat.high)));
    const int fitting = std::max(1, static_cast<int>(height / each));
    const int apart = std::max(1, (high - low + fitting - 1) / fitting);
    std::vector<int> all;
    for (int d = high; d >= low; d -= apart) all.push_back(d);
    return all;
}

/// At the lower end, in the middle and at the upper end.
std::array<QString, 3> ticksOf(const ColourScale& scale) {
    const auto text = [](double value) { return QString::fromStdString(shortNumber(value)); };
    return {text(scale.low), text((scale.low + scale.high) / 2), text(scale.high)};
}

/// From below to above, with its middle here.
void drawScaleTitle(QPainter& painter, const Theme& theme, QPointF middle, const QString& title) {
    const QFont font = scaleFont(theme);
    const QFontMetricsF metrics(font);
    painter.save();
    painter.setPen(theme.text);
    painter.translate(middle);
    painter.rotate(-90);
    drawTitle(painter, font, {-metrics.horizontalAdvance(plainTitle(title)) / 2, -metrics.descent()}, title);
    painter.restore();
}

}  // namespace

int scaleWidth(const Figure& figure, const Theme& theme) {
    if (const ColourScale* scale = figure.find<ColourScale>()) {
        const QFontMetricsF metrics(scaleFont(theme));
        double widest = 0;
        for (const QString& text : ticksOf(*scale))
            widest = std::max(widest, metrics.horizontalAdvance(text));
        return static_cast<int>(barLeft + barWidth + tickLength + 3 + widest + metrics.height() + 5);
    }
    if (!figure.heat() || figure.heat()->scale.empty()) return 0;
    const QFontMetricsF metrics(scaleFont(theme));
    return static_cast<int>(barLeft + barWidth + tickLength + 3 + metrics.horizontalAdvance(powerOfTen(-10)) +
                            metrics.height() + 5);
}

QImage fadedCells(const HeatMap& heat, const Theme& theme) {
    const auto rgb = [](const QColor& c) { return std::array<double, 3>{c.redF(), c.greenF(), c.blueF()}; };
    const FadedColours colours{rgb(theme.panel), rgb(theme.accent), rgb(theme.series(1).color)};
    const auto byte = [](double part) { return static_cast<int>(255 * part + 0.5); };
    QImage image(heat.columns, heat.rows, QImage::Format_RGB32);
    for (int row = 0; row < heat.rows; ++row) {
        auto* const pixels = reinterpret_cast<QRgb*>(image.scanLine(heat.rows - 1 - row));
        for (int column = 0; column < heat.columns; ++column) {
            const auto c = fadedCell(heat, static_cast<std::size_t>(column * heat.rows + row), colours);
            pixels[column] = qRgb(byte(c[0]), byte(c[1]), byte(c[2]));
        }
    }
    return image;
}

namespace {

/// The rectangles of the cells of a map on a painter.
class CellPlaces {
public:
    CellPlaces(const QCPPainter& painter, const PixelMap& map, const HeatMap& heat)
        : heat_(heat),
          corner_(map(heat.left, heat.top)),
          opposite_(map(heat.right, heat.bottom)),
          isVector_(painter.modes().testFlag(QCPPainter::pmVectorized)),
          finer_(std::max(1.0, painter.transform().m11())) {}

    QRectF at(int column, int row) const {
        return {QPointF(edge(corner_.x(), opposite_.x(), column, heat_.columns),
                        edge(opposite_.y(), corner_.y(), row + 1, heat_.rows)),
                QPointF(edge(corner_.x(), opposite_.x(), column + 1, heat_.columns),
                        edge(opposite_.y(), corner_.y(), row, heat_.rows))};
    }
    /// The same, on vectors with a rim below the cells that are painted after it, to the right and above:
    /// programs that show a page smooth each edge by itself, and the ground would shine through where two
    /// cells only touch.
    QRectF withRim(int column, int row) const {
        constexpr double rim = 0.7;
        const QRectF cell = at(column, row);
        if (!isVector_) return cell;
        return cell.adjusted(0, isPainted(column, row + 1) ? -rim : 0, isPainted(column + 1, row) ? rim : 0,
                             0);
    }

private:
    /// On whole pixels of pictures.
    double edge(double from, double to, int i, int count) const {
        const double place = from + (to - from) * i / count;
        return isVector_ ? place : std::round(place * finer_) / finer_;
    }
    bool isPainted(int column, int row) const {
        if (column >= heat_.columns || row >= heat_.rows) return false;
        const auto i = static_cast<std::size_t>(column * heat_.rows + row);
        return std::isfinite(heat_.values[i]) || faultOf(heat_.faults[i]) != Fault::none;
    }

    const HeatMap& heat_;
    QPointF corner_, opposite_;
    bool isVector_;
    double finer_;
};

}  // namespace

void drawMapCells(QCPPainter& painter, const PixelMap& map, const FigurePlot::Shared& shared) {
    const HeatMap& heat = *shared.figure.heat();
    const CellPlaces places(painter, map, heat);
    const double decades = std::log10(heat.high / heat.low);
    painter.setAntialiasing(false);
    painter.setOpacity(shared.isStale ? 0.4 : 1);
    for (int column = 0; column < heat.columns; ++column)
        for (int row = 0; row < heat.rows; ++row) {
            const auto i = static_cast<std::size_t>(column * heat.rows + row);
            if (!map.rect.intersects(places.at(column, row))) continue;
            const double value = heat.values[i];
            if (std::isfinite(value))
                painter.fillRect(places.withRim(column, row),
                                 valueColour(value > 0 ? std::log10(value / heat.low) / decades : 0));
            const Fault fault = faultOf(heat.faults[i]);
            if (fault != Fault::none && (fault == Fault::drifting) == std::isfinite(value))
                fillFault(painter, places.at(column, row), shared.theme, fault);
        }
    painter.setOpacity(1);
    painter.setAntialiasing(true);
}

void drawMapScale(QCPPainter& painter, const PixelMap& map, const FigurePlot::Shared& shared) {
    const HeatMap& heat = *shared.figure.heat();
    const Theme& theme = shared.theme;
    const QFont font = scaleFont(theme);
    const QFontMetricsF metrics(font);
    painter.setFont(font);
    const double left = map.rect.right() + barLeft, line = metrics.height();
    double bottom = map.rect.bottom();
    // What has no colour of the scale stands below it, if there is any.
    for (const Fault fault : {Fault::blowUp, Fault::failed, Fault::drifting}) {
        if (std::none_of(heat.faults.begin(), heat.faults.end(),
                         [&](const std::string& f) { return faultOf(f) == fault; }))
            continue;
        const QRectF sample(left, bottom - barWidth, barWidth, barWidth);
        if (fault == Fault::drifting) painter.fillRect(sample, valueColour(0.5));
        fillFault(painter, sample, theme, fault);
        painter.setPen(theme.muted);
        painter.drawText(QPointF(left + barWidth + 4, bottom - 1), nameOf(fault));
        bottom -= line + 3;
    }
    const double top = map.rect.top();
    if (bottom < map.rect.bottom()) bottom -= 3;
    const double height = bottom - top;
    if (height < 2 * line) return;
    QLinearGradient colours(0, bottom, 0, top);
    for (int i = 0; i <= 24; ++i) colours.setColorAt(i / 24.0, valueColour(i / 24.0));
    painter.fillRect(QRectF(left, top, barWidth, height), colours);
    const double low = std::log10(heat.low), high = std::log10(heat.high);
    double widest = 0;
    for (const int decade : decadesOf(heat, height, 1.6 * line)) {
        const double y = std::round(bottom - height * (decade - low) / (high - low)) + 0.5;
        painter.setPen(QPen(theme.line, 1));
        painter.drawLine(QPointF(left + barWidth, y), QPointF(left + barWidth + tickLength, y));
        painter.setPen(theme.muted);
        const QString text = powerOfTen(decade);
        const double x = left + barWidth + tickLength + 3;
        const double base = std::clamp(y + metrics.ascent() / 2 - 1, top + metrics.ascent() - 2, bottom + 2);
        painter.drawText(QPointF(x, base), text);
        widest = std::max(widest, metrics.horizontalAdvance(text));
    }
    const QString title = QString::fromStdString(heat.scale);
    if (metrics.horizontalAdvance(plainTitle(title)) > height) return;  // the subtitle says it as well
    drawScaleTitle(painter, theme, {left + barWidth + tickLength + 6 + widest + line, top + height / 2},
                   title);
}

void drawColourScale(QCPPainter& painter, const PixelMap& map, const Theme& theme, const ColourScale& scale) {
    const QFont font = scaleFont(theme);
    const QFontMetricsF metrics(font);
    painter.setFont(font);
    const double left = map.rect.right() + barLeft, top = map.rect.top(), height = map.rect.height();
    if (height < 2 * metrics.height()) return;
    QLinearGradient colours(0, map.rect.bottom(), 0, top);
    for (int i = 0; i <= 24; ++i) colours.setColorAt(i / 24.0, valueColour(i / 24.0));
    painter.fillRect(QRectF(left, top, barWidth, height), colours);
    const auto ticks = ticksOf(scale);
    double widest = 0;
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        const double y = std::round(map.rect.bottom() - height * static_cast<double>(k) / 2) + 0.5;
        painter.setPen(QPen(theme.line, 1));
        painter.drawLine(QPointF(left + barWidth, y), QPointF(left + barWidth + tickLength, y));
        painter.setPen(theme.muted);
        const double base =
            std::clamp(y + metrics.ascent() / 2 - 1, top + metrics.ascent() - 2, map.rect.bottom() + 2);
        painter.drawText(QPointF(left + barWidth + tickLength + 3, base), ticks[k]);
        widest = std::max(widest, metrics.horizontalAdvance(ticks[k]));
    }
    const QString title = QString::fromStdString(scale.title);
    drawScaleTitle(painter, theme,
                   {left + barWidth + tickLength + 6 + widest + metrics.height(), top + height / 2}, title);
}

}  // namespace extremal
