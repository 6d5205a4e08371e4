// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/figure/build.hpp"
#include "engine/figure/sample.hpp"
#include "ui/plots/axis_title.hpp"
#include "ui/plots/dense_curve.hpp"
#include "ui/plots/dot_stamp.hpp"
#include "ui/plots/map_layer.hpp"
#include "ui/plots/pill.hpp"
#include "ui/plots/value_colour.hpp"

namespace extremal {

PixelMap FigurePlot::Shared::map() const {
    return {view.range(PlotAxis::x), view.range(PlotAxis::y), figure.x.isLog, figure.y.isLog,
            QRectF(plot.axisRect()->rect())};
}

QColor FigurePlot::Shared::colorOf(int style) const {
    const QColor c = theme.series(style).color;
    return !isStale || style < 0 ? c : mixed(c);
}

QColor FigurePlot::Shared::shaded(double shade) const {
    return isStale ? mixed(valueColour(shade)) : valueColour(shade);
}

QColor FigurePlot::Shared::mixed(const QColor& c) const {
    const auto mix = [](int a, int b) { return (35 * a + 65 * b) / 100; };  // opaque: overlaps must not show
    return {mix(c.red(), theme.panel.red()), mix(c.green(), theme.panel.green()),
            mix(c.blue(), theme.panel.blue())};
}

bool FigurePlot::Shared::hasOwnTitles() const {
    return hasOwnParts(QString::fromStdString(figure.x.title)) ||
           hasOwnParts(QString::fromStdString(figure.y.title));
}

bool FigurePlot::Shared::isFaded(const Series& s) const {
    if (highlighted.isEmpty() || s.style < 0 || QString::fromStdString(s.label) == highlighted) return false;
    const auto all = figure.series();
    return std::any_of(all.begin(), all.end(), [&](const Series& other) {
        return QString::fromStdString(other.label) == highlighted && isShown(other);
    });
}

CurvesLayer::CurvesLayer(const FigurePlot::Shared& shared)
    : QCPLayerable(&shared.plot, "main"), shared_(shared) {}
MarksLayer::MarksLayer(const FigurePlot::Shared& shared)
    : QCPLayerable(&shared.plot, "legend"), shared_(shared) {}

namespace {

/// Of clouds, in sight.
std::size_t dotsIn(const Figure& figure, const PixelMap& map) {
    std::size_t dots = 0;
    for (const Series& s : figure.series()) {
        if (!hasMarks(s.kind) || hasLine(s.kind)) continue;
        const std::size_t stride = s.x.size() / 20000 + 1;
        for (std::size_t i = 0; i < s.x.size(); i += stride)
            if (map.rect.contains(map(s.x[i], s.y[i]))) dots += stride;
    }
    return dots;
}

/// The radius of the dots of clouds: smaller where all of them, side by side, would cover more than a part of
/// the plot.
double dotRadius(std::size_t dots, const PixelMap& map) {
    constexpr double largest = 1.7, smallest = 0.5, covered = 0.25;
    const double room = covered * map.rect.width() * map.rect.height();
    return std::clamp(std::sqrt(room / (std::numbers::pi * std::max<double>(1, static_cast<double>(dots)))),
                      smallest, largest);
}

/// A polyline in short pieces: one long path takes quadratic time in the stroker. The dash goes on across
/// pieces.
void drawPieces(QCPPainter& painter, QPen pen, const QPolygonF& line) {
    if (line.size() == 1) {
        pen.setStyle(Qt::SolidLine);
        pen.setCapStyle(Qt::RoundCap);
        painter.setPen(pen);
        painter.drawPoint(line.front());
        return;
    }
    const qsizetype pieceLength = painter.modes().testFlag(QCPPainter::pmVectorized) ? 4000 : 120;
    double done = 0;
    for (qsizetype start = 0; start + 1 < line.size(); start += pieceLength) {
        const qsizetype count = std::min(pieceLength + 1, line.size() - start);
        if (pen.style() == Qt::CustomDashLine) pen.setDashOffset(done / pen.widthF());
        painter.setPen(pen);
        painter.drawPolyline(line.constData() + start, static_cast<int>(count));
        for (qsizetype i = start + 1; i < start + count; ++i) {
            const QPointF d = line[i] - line[i - 1];
            done += std::hypot(d.x(), d.y());
        }
    }
}

/// Lines, and bands as a tint between their edges; on a logarithmic axis the upper edge alone is drawn,
/// because the lower one is where the sampled zeros happen to be.
void drawVisible(QCPPainter& painter, QPen pen, const VisibleLine& visible, const PixelMap& map) {
    QColor tint = pen.color();
    tint.setAlphaF(0.22f);
    for (const VisibleLine::Band& band : visible.bands) {
        QPolygonF area = band.upper;
        area.append(QPolygonF(band.lower.rbegin(), band.lower.rend()));
        painter.setPen(Qt::NoPen);
        painter.setBrush(tint);
        painter.drawPolygon(area);
        painter.setBrush(Qt::NoBrush);
    }
    if (!visible.dots.isEmpty()) {
        painter.setPen(QPen(pen.color(), 1.6 * pen.widthF(), Qt::SolidLine, Qt::RoundCap));
        painter.drawPoints(visible.dots);
    }
    if (visible.isDense && !painter.modes().testFlag(QCPPainter::pmVectorized)) {
        painter.drawImage(map.rect.topLeft(), denseImage(visible.lines, map, pen.color(), pen.widthF(),
                                                         painter.deviceTransform().m11()));
        return;
    }
    if (visible.isDense) pen.setStyle(Qt::SolidLine);
    for (const QPolygonF& line : visible.lines) drawPieces(painter, pen, line);
    for (const VisibleLine::Band& band : visible.bands) {
        drawPieces(painter, pen, band.upper);
        if (!map.isYLog) drawPieces(painter, pen, band.lower);
    }
}

void drawCross(QCPPainter& painter, QPointF at) {
    painter.drawLine(at + QPointF(-4, -4), at + QPointF(4, 4));
    painter.drawLine(at + QPointF(-4, 4), at + QPointF(4, -4));
}

}  // namespace

void CurvesLayer::draw(QCPPainter* painter) {
    const PixelMap map = shared_.map();
    if (map.rect.width() < 1 || map.rect.height() < 1) return;  // no room for a plot
    drawHeat(*painter, map);
    drawFloor(*painter, map);
    drawGuides(*painter, map);
    drawAreas(*painter, map);
    dots_ = dotsIn(shared_.figure, map);
    const Series* highlighted = nullptr;
    for (const Series& s : shared_.figure.series()) {
        if (!shared_.isShown(s)) continue;
        if (QString::fromStdString(s.label) == shared_.highlighted)
            highlighted = &s;
        else
            drawSeries(*painter, map, s);
    }
    if (highlighted) drawSeries(*painter, map, *highlighted);
    drawKey(*painter, map);
}

/// The length of curves that a box would hide, by some thousands of points of each.
double CurvesLayer::hiddenBy(const QRectF& box, const PixelMap& map) const {
    constexpr double spacing = 5;
    double hidden = 0;
    for (const Series& s : shared_.figure.series()) {
        const std::size_t stride = s.x.size() / 4000 + 1;
        for (std::size_t i = stride; i < s.x.size() && shared_.isShown(s) && hasLine(s.kind); i += stride) {
            const QPointF from = map(s.x[i - stride], s.y[i - stride]), to = map(s.x[i], s.y[i]);
            const double length = std::hypot(to.x() - from.x(), to.y() - from.y());
            if (!std::isfinite(length)) continue;
            const int points = std::clamp(static_cast<int>(length / spacing), 1, 200);
            for (int k = 0; k < points; ++k)
                if (box.contains(from + (to - from) * ((k + 0.5) / points))) hidden += length / points;
        }
    }
    return hidden;
}

/// The names of curves that belong to no scheme, in the corner where they hide least, first of all top right:
/// the legend has the schemes alone.
void CurvesLayer::drawKey(QCPPainter& painter, const PixelMap& map) const {
    constexpr double sample = 22, gap = 5, edge = 5;
    const QFont font = small(shared_.theme);
    const QFontMetricsF metrics(font);
    double topRight = map.rect.top() + 4, topLeft = topRight, bottomRight = map.rect.bottom() - 4,
           bottomLeft = bottomRight;
    for (const Series& s : shared_.figure.series()) {
        const bool isTitled = s.style == exactStyle && shared_.figure.series().size() == 1;
        if (s.style >= 0 || isTitled || map.rect.width() < 100) continue;
        const QString text = metrics.elidedText(QString::fromStdString(s.label), Qt::ElideRight,
                                                map.rect.width() - sample - gap - 2 * edge - 8);
        const double width = sample + gap + metrics.horizontalAdvance(text) + 2 * edge;
        // Marks of failures are top left.
        const QSizeF size(width, metrics.height() + 4);
        const double left = map.rect.left() + 4, right = map.rect.right() - 4 - width;
        std::array<double*, 4> edges{&topRight, &topLeft, &bottomRight, &bottomLeft};
        std::array<QRectF, 4> boxes{QRectF(QPointF(right, topRight), size),
                                    QRectF(QPointF(left, topLeft), size),
                                    QRectF(QPointF(right, bottomRight - size.height()), size),
                                    QRectF(QPointF(left, bottomLeft - size.height()), size)};
        std::size_t corner = 0;
        for (std::size_t i = 1; i < 4; ++i)
            if ((i != 1 || shared_.figure.all<FailureMark>().empty()) &&
                hiddenBy(boxes[i], map) < hiddenBy(boxes[corner], map) - 1)
                corner = i;
        const QRectF box = boxes[corner];
        *edges[corner] = corner < 2 ? box.bottom() + 2 : box.top() - 2;
        QColor ground = shared_.theme.panel;
        ground.setAlphaF(0.88f);
        painter.setPen(Qt::NoPen);
        painter.setBrush(ground);
        painter.drawRoundedRect(box, 4, 4);
        painter.setBrush(Qt::NoBrush);
        QPen pen(shared_.colorOf(s.style), 1.1, Qt::SolidLine, Qt::FlatCap);
        if (const auto dash = shared_.theme.series(s.style).dash; !dash.isEmpty()) pen.setDashPattern(dash);
        if (hasLine(s.kind)) {
            painter.setPen(pen);
            painter.drawLine(QPointF(box.left() + edge, box.center().y()),
                             QPointF(box.left() + edge + sample, box.center().y()));
        } else {
            painter.setPen(QPen(pen.color(), 4, Qt::SolidLine, Qt::RoundCap));
            painter.drawPoint(QPointF(box.left() + edge + sample / 2, box.center().y()));
        }
        painter.setFont(font);
        painter.setPen(shared_.theme.muted);
        painter.drawText(QRectF(box.left() + edge + sample + gap, box.top(), width, box.height()),
                         Qt::AlignVCenter | Qt::AlignLeft, text);
    }
}

/// One pixel a cell, stretched.
void CurvesLayer::drawHeat(QCPPainter& painter, const PixelMap& map) const {
    const auto& heat = shared_.figure.heat();
    if (!heat || heat->columns <= 0 || heat->rows <= 0) return;
    if (!heat->scale.empty()) return drawMapCells(painter, map, shared_);
    if (shared_.fadedCells.isNull()) shared_.fadedCells = fadedCells(*heat, shared_.theme);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, true);
    painter.setOpacity(shared_.isStale ? 0.4 : 1);
    painter.drawImage(QRectF(map(heat->left, heat->top), map(heat->right, heat->bottom)), shared_.fadedCells);
    painter.setOpacity(1);
}

void CurvesLayer::drawFloor(QCPPainter& painter, const PixelMap& map) const {
    const auto level = [&](double value) { return map(map.x.low, value).y(); };
    if (const auto* band = shared_.figure.find<DoubtfulBand>(); band && band->top > map.y.low) {
        QColor tint = shared_.theme.muted;
        tint.setAlphaF(0.07f);
        const double top = std::max(level(band->top), map.rect.top());
        painter.fillRect(QRectF(map.rect.left(), top, map.rect.width(), map.rect.bottom() - top), tint);
    }
    if (const auto* floor = shared_.figure.find<RoundOffFloor>();
        floor && floor->y > map.y.low && floor->y < map.y.high) {
        painter.setPen(QPen(shared_.theme.muted, 1, Qt::DotLine));
        painter.setOpacity(0.6);
        const double y = std::round(level(floor->y)) + 0.5;
        painter.drawLine(QPointF(map.rect.left(), y), QPointF(map.rect.right(), y));
        painter.setOpacity(1);
    }
}

void CurvesLayer::drawAreas(QCPPainter& painter, const PixelMap& map) const {
    painter.setPen(Qt::NoPen);
    for (const Area& area : shared_.figure.all<Area>()) {
        if (shared_.hidden.contains(QString::fromStdString(area.label))) continue;
        QPolygonF polygon;
        for (std::size_t i = 0; i < area.x.size(); ++i) polygon << map(area.x[i], area.y[i]);
        QColor tint = shared_.colorOf(area.style);
        tint.setAlphaF(0.18f);
        painter.setBrush(tint);
        painter.drawPolygon(polygon);
    }
    painter.setBrush(Qt::NoBrush);
}

void CurvesLayer::drawGuides(QCPPainter& painter, const PixelMap& map) const {
    for (const Guide& guide : shared_.figure.all<Guide>()) {
        const QPen pen(guide.isStrong ? shared_.theme.muted : shared_.theme.line, guide.isBroad ? 9 : 1,
                       Qt::SolidLine, Qt::FlatCap, guide.isBroad ? Qt::RoundJoin : Qt::BevelJoin);
        drawVisible(painter, pen, visibleCurve(guide.x, guide.y, map, shared_.density), map);
    }
    painter.setFont(shared_.theme.caption());
    painter.setPen(shared_.theme.muted);
    for (const Label& label : shared_.figure.all<Label>()) {
        const QPointF at = map(label.x, label.y);
        painter.drawText(QRectF(at.x() - 40, at.y() - 12, 80, 24), Qt::AlignCenter,
                         QString::fromStdString(label.text));
    }
}

void CurvesLayer::drawSeries(QCPPainter& painter, const PixelMap& map, const Series& series) const {
    const SeriesStyle style = shared_.theme.series(series.style);
    const bool isHighlighted = QString::fromStdString(series.label) == shared_.highlighted;
    QColor color = series.shade                ? shared_.shaded(*series.shade)
                   : series.tone == Tone::pale ? shared_.theme.pale(shared_.colorOf(series.style), paleLine)
                                               : shared_.colorOf(series.style);
    if (shared_.isFaded(series)) color = shared_.theme.pale(color, fadedLine);
    if (hasLine(series.kind)) {
        const double width = shared_.theme.lineWidth * (series.style == formulaStyle ? 1.1
                                                        : isHighlighted              ? 2.4
                                                                                     : 1.5);
        QPen pen(color, width, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin);
        if (!style.dash.isEmpty() && !series.shade) pen.setDashPattern(style.dash);
        const bool isCurve = isParametric(series.kind);
        const auto visible = isCurve ? visibleCurve : visibleLine;
        drawVisible(painter, pen,
                    series.isSparse ? visibleSamples(series.x, series.y, map, isCurve, shared_.density)
                                    : visible(series.x, series.y, map, shared_.density),
                    map);
    }
    if (series.kind == SeriesKind::cells) drawCells(painter, map, series);
    if (series.kind == SeriesKind::ticks) {
        const double unit = std::abs(map(map.x.low, 1).y() - map(map.x.low, 0).y()),
                     half = std::min(isHighlighted ? 9.0 : 7.0, (isHighlighted ? 0.45 : 0.35) * unit);
        painter.setPen(QPen(color, 1));
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            const QPointF p = map(series.x[i], series.y[i]);
            if (std::isfinite(p.x()) && std::isfinite(p.y()) && map.rect.adjusted(-1, 0, 1, 0).contains(p))
                painter.drawLine(p - QPointF(0, half), p + QPointF(0, half));
        }
    }
    if (hasMarks(series.kind)) drawMarks(painter, map, series, color);
}

void CurvesLayer::drawMarks(QCPPainter& painter, const PixelMap& map, const Series& series,
                            const QColor& color) const {
    constexpr std::size_t few = 100;  // more are dots: a cloud, not points to be told apart
    const bool isCloud = (series.shade || series.x.size() > few) && !hasLine(series.kind);
    const bool isHighlighted = QString::fromStdString(series.label) == shared_.highlighted;
    double radius = isHighlighted ? 6 : 4.5;
    if (isCloud) radius = dotRadius(dots_, map) + (isHighlighted ? 0.4 : 0);
    painter.setPen(isCloud ? QPen(Qt::NoPen) : QPen(shared_.theme.panel, 1.2));
    painter.setBrush(color);
    constexpr std::size_t many = 5000;  // below, ellipses take no time and are at their places exactly
    std::optional<DotStamp> stamp;
    const QTransform transform = painter.transform();  // QCPPainter moves what is antialiased by half a pixel
    if (isCloud && dots_ > many && !painter.modes().testFlag(QCPPainter::pmVectorized) &&
        transform.type() <= QTransform::TxTranslate) {
        stamp.emplace(color, radius, painter.device()->devicePixelRatioF());
        painter.setTransform({});
    }
    const QRectF seen = map.rect.adjusted(-6, -6, 6, 6);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const QPointF p = map(series.x[i], series.y[i]);
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !seen.contains(p)) continue;
        if (stamp)
            stamp->draw(painter, transform.map(p));
        else
            painter.drawEllipse(p, radius, radius);
    }
    painter.setTransform(transform);
    painter.setBrush(Qt::NoBrush);
}

/// Unit squares with a hairline between them where there is room.
void CurvesLayer::drawCells(QCPPainter& painter, const PixelMap& map, const Series& series) const {
    QColor color = shared_.colorOf(series.style);
    if (series.tone == Tone::pale) color = shared_.theme.pale(color, 40);
    const double side = std::abs(map(1, 0).x() - map(0, 0).x()), gap = side > 5 ? 0.5 : 0;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const QRectF cell =
            QRectF(map(series.x[i] - 0.5, series.y[i] + 0.5), map(series.x[i] + 0.5, series.y[i] - 0.5));
        if (map.rect.intersects(cell))
            painter.fillRect(cell.adjusted(gap, gap, -gap, -gap).intersected(map.rect), color);
    }
}

void MarksLayer::draw(QCPPainter* painter) {
    const PixelMap map = shared_.map();
    if (shared_.isTitleAbove) drawTitleAbove(*painter, map);
    painter->setPen(shared_.theme.text);
    for (const auto& [axis, title] : {std::pair{shared_.plot.xAxis, &shared_.figure.x.title},
                                      std::pair{shared_.plot.yAxis, &shared_.figure.y.title}})
        if (const QString text = QString::fromStdString(*title);
            shared_.figure.message.empty() && hasOwnParts(text) &&
            !(axis == shared_.plot.yAxis && shared_.isTitleAbove))
            drawAxisTitle(*painter, *axis, text);
    drawEvents(*painter, map);
    drawFailures(*painter, map);
    if (shared_.figure.heat() && !shared_.figure.heat()->scale.empty()) drawMapScale(*painter, map, shared_);
    if (const ColourScale* scale = shared_.figure.find<ColourScale>())
        drawColourScale(*painter, map, shared_.theme, *scale);
    if (shared_.figure.message.empty()) return;
    painter->setFont(shared_.theme.caption());
    painter->setPen(shared_.theme.muted);
    painter->drawText(map.rect.adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap,
                      QString::fromStdString(shared_.figure.message));
}

void MarksLayer::drawTitleAbove(QCPPainter& painter, const PixelMap& map) const {
    const QCPAxis& axis = *shared_.plot.yAxis;
    const QFontMetricsF metrics(axis.labelFont());
    const QRectF line(4, map.rect.top() - 10 - metrics.height(), map.rect.right() - 4, metrics.height());
    painter.setFont(axis.labelFont());
    painter.setPen(shared_.theme.text);
    const QString title = QString::fromStdString(shared_.figure.y.title), plain = plainTitle(title);
    if (hasOwnParts(title) && metrics.horizontalAdvance(plain) <= line.width())
        drawTitle(painter, axis.labelFont(),
                  {line.left(), line.center().y() + (metrics.ascent() - metrics.descent()) / 2}, title);
    else
        painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                         metrics.elidedText(plain, Qt::ElideRight, line.width()));
}

/// The last point of a scheme's curve that is inside the plot.
std::optional<QPointF> MarksLayer::endOfCurve(const std::string& label, const PixelMap& map) const {
    for (const Series& s : shared_.figure.series()) {
        if (s.label != label || s.kind != SeriesKind::curve) continue;
        for (std::size_t i = s.x.size(); i-- > 0;)
            if (const QPointF p = map(s.x[i], s.y[i]); map.rect.contains(p)) return p;
    }
    return {};
}

void MarksLayer::drawFailures(QCPPainter& painter, const PixelMap& map) const {
    const Theme& theme = shared_.theme;
    const QFont font = small(theme);
    double top = map.rect.top() + 2;
    for (const FailureMark& f : shared_.figure.all<FailureMark>()) {
        const QString label = QString::fromStdString(f.label);
        if (shared_.hidden.contains(label)) continue;
        QPointF cross(map.rect.left() + 8, top + 9);
        if (const auto end = endOfCurve(f.label, map); end) {
            painter.setPen(QPen(shared_.colorOf(f.style), 2));
            drawCross(painter, *end);
            continue;  // the plots over time say the rest
        }
        if (shared_.figure.x.isTime) {
            if (f.x < map.x.low || f.x > map.x.high) continue;
            cross.setX(map(f.x, map.y.low).x());
            painter.setPen(QPen(shared_.colorOf(f.style), 1, Qt::DashLine));
            painter.drawLine(QPointF(cross.x(), top + 15), QPointF(cross.x(), map.rect.bottom()));
        }
        painter.setPen(QPen(shared_.colorOf(f.style), 2));
        drawCross(painter, cross);

        const double right = map.rect.right() - cross.x() - 12, left = cross.x() - 12 - map.rect.left();
        const double room = std::max(right, left) - 14;
        if (room < 50) continue;
        const QString full = label + QStringLiteral(": ") + QString::fromStdString(f.text);
        const QString text = QFontMetricsF(font).elidedText(full, Qt::ElideRight, room);
        const double width = QFontMetricsF(font).horizontalAdvance(text) + 12;
        const double x = right >= left || width <= right ? cross.x() + 9 : cross.x() - 9 - width;
        top = drawPill(painter, {x, top}, text, font, theme.warningGround, theme.warningLine, theme.warning)
                  .bottom() +
              4;
        if (top > map.rect.bottom() - 20) return;
    }
}

/// A small triangle that stands on the curve, or on the lower edge.
void MarksLayer::drawEvents(QCPPainter& painter, const PixelMap& map) const {
    constexpr double half = 3.5, height = 6, least = 2 * half + 1;  // pixels between two of a scheme
    for (const EventMarks& marks : shared_.figure.all<EventMarks>()) {
        if (shared_.hidden.contains(QString::fromStdString(marks.label))) continue;
        painter.setPen(QPen(shared_.colorOf(marks.style), 1.1));
        painter.setBrush(shared_.theme.panel);
        std::optional<QPointF> last;
        for (std::size_t i = 0; i < marks.x.size(); ++i) {
            QPointF at(map(marks.x[i], map.y.low).x(), map.rect.bottom());
            if (const QPointF on = map(marks.x[i], marks.y[i]); std::isfinite(on.y())) at = on;
            if (!std::isfinite(at.x()) || !map.rect.adjusted(-1, -1, 1, 1).contains(at)) continue;
            if (last && std::hypot(at.x() - last->x(), at.y() - last->y()) < least) continue;
            last = at;
            const QPointF tip = at - QPointF(0, 1.5);
            painter.drawPolygon(QPolygonF{tip, tip + QPointF(-half, -height), tip + QPointF(half, -height)});
        }
        painter.setBrush(Qt::NoBrush);
    }
}

}  // namespace extremal
