// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/figure_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/plots/axis_title.hpp"
#include "ui/plots/map_layer.hpp"
#include "ui/plots/plot_layers.hpp"
#include "ui/plots/tickers.hpp"

namespace extremal {
namespace {

QFont axisTitleFont(const Theme& theme) {
    QFont font = theme.caption();
    font.setWeight(QFont::DemiBold);
    return font;
}

void styleAxis(QCPAxis& axis, const Theme& theme, bool isSmall) {
    const QPen hairline(theme.line, 1);
    axis.setBasePen(hairline);
    axis.setTickPen(hairline);
    axis.setSubTickPen(hairline);
    axis.setTickLength(0, 4);
    axis.setSubTickLength(0, 2);
    axis.setTickLabelPadding(axis.axisType() == QCPAxis::atLeft ? 5 : 4);
    axis.setLabelPadding(isSmall ? 2 : 4);
    axis.setTickLabelFont(theme.caption());
    axis.setTickLabelColor(theme.muted);
    axis.setLabelFont(axisTitleFont(theme));
    axis.setLabelColor(theme.text);
    axis.setPadding(isSmall ? 1 : 3);
    axis.grid()->setPen(QPen(theme.grid, 1));
    axis.grid()->setZeroLinePen(Qt::NoPen);
    axis.grid()->setSubGridVisible(false);
}

/// Number of labels for which an axis has room.
int roomFor(double length, bool isVertical, bool isLog) {
    const double each = isVertical ? (isLog ? 26 : 30) : (isLog ? 46 : 64);
    return std::max(3, static_cast<int>(length / each));
}

PlotRange toPlotRange(const std::optional<std::pair<double, double>>& range) {
    return range ? PlotRange{range->first, range->second} : PlotRange{};
}

/// One unit as long on both axes: the axis with the longer units keeps its range, the other one is widened.
void makeScalesEqual(ViewState& view, QSize pixels) {
    PlotRange x = view.range(PlotAxis::x), y = view.range(PlotAxis::y);
    const double unit = std::max((x.high - x.low) / pixels.width(), (y.high - y.low) / pixels.height());
    const auto widen = [&](PlotAxis axis, PlotRange r, double length) {
        const double middle = (r.low + r.high) / 2, half = unit * length / 2;
        if (r.high - r.low >= 2 * half * (1 - 1e-9)) return;
        if (view.isUserChosen(axis))
            view.choose(axis, {middle - half, middle + half});
        else
            view.setFitted(axis, {middle - half, middle + half});
    };
    widen(PlotAxis::x, x, pixels.width());
    widen(PlotAxis::y, y, pixels.height());
}

/// The marks of failures stand above the curves: the fitted range leaves them up to a third of the height.
void makeRoomForMarks(FigurePlot::Shared& s, int height) {
    const auto count = static_cast<double>(s.figure.all<FailureMark>().size());
    if (count == 0 || !s.figure.x.isTime || height <= 0) return;
    const double share = std::min(0.33, 22 * count / height);
    const PlotRange r = toPlotRange(s.figure.y.range);
    const double stretch = 1 / (1 - share);
    const double high =
        s.figure.y.isLog ? r.low * std::pow(r.high / r.low, stretch) : r.low + (r.high - r.low) * stretch;
    s.view.setFitted(PlotAxis::y, {r.low, high});
}

/// Ranges, and the ticks for which a plot of this size has room; then the sizes of its margins.
void layOut(FigurePlot::Shared& s, double width, double height) {
    const auto prepareAxis = [&](QCPAxis& axis, const Axis& of, PlotRange range, double length) {
        axis.setRange(range.low, range.high);
        const bool isVertical = axis.orientation() == Qt::Vertical;
        const int room = roomFor(length, isVertical, of.isLog);
        constexpr double roomOfName = 22;
        if (of.ticks.empty())
            axis.setTicker(of.isLog ? logTicker(room)
                                    : linearTicker(room, {isVertical ? 0 : length, axis.tickLabelFont()}));
        else
            axis.setTicker(namedTicker(of.ticks, roomOfName * (axis.range().size() / std::max(1.0, length))));
        axis.grid()->setVisible(s.figure.axes == AxisStyle::scales && of.ticks.empty());
    };
    prepareAxis(*s.plot.xAxis, s.figure.x, s.view.range(PlotAxis::x), width);
    prepareAxis(*s.plot.yAxis, s.figure.y, s.view.range(PlotAxis::y), height);
    s.plot.plotLayout()->update(QCPLayoutElement::upPreparation);
    s.plot.plotLayout()->update(QCPLayoutElement::upMargins);
    s.plot.plotLayout()->update(QCPLayoutElement::upLayout);
}

}  // namespace

FigurePlot::FigurePlot(QCustomPlot& plot, const Theme& theme)
    : shared_(new Shared{plot, theme, {}, {}, {}, {}, {}}) {
    plot.setInteractions(QCP::iNone);
    plot.setPlottingHint(QCP::phFastPolylines, true);
    plot.setPlottingHint(QCP::phCacheLabels, true);
    plot.setNotAntialiasedElements(QCP::aeAxes | QCP::aeGrid);
    plot.xAxis->setNumberFormat("gb");
    plot.axisRect()->setMinimumMargins(QMargins(8, 8, 16, 0));
    plot.addLayer("cursor", plot.layer("overlay"), QCustomPlot::limBelow);
    plot.layer("cursor")->setMode(QCPLayer::lmBuffered);
    new CurvesLayer(*shared_);  // owned by the plot
    new MarksLayer(*shared_);
    new CursorLayer(*shared_);
    setTheme(theme);
}

FigurePlot::~FigurePlot() = default;

void FigurePlot::setTheme(const Theme& theme) {
    shared_->theme = theme;
    shared_->fadedCells = {};
    shared_->plot.setBackground(QBrush(theme.panel));
}

void FigurePlot::setFigure(Figure figure) {
    if (figure.x.isLog != shared_->figure.x.isLog || figure.y.isLog != shared_->figure.y.isLog ||
        figure.view != shared_->figure.view) {
        shared_->view.fit();
        shared_->view.forget();
    }
    shared_->view.setLog(figure.x.isLog, figure.y.isLog);
    shared_->figure = std::move(figure);
    moveCurves();
    shared_->fadedCells = {};
    shared_->view.setFitted(PlotAxis::x, toPlotRange(shared_->figure.x.range));
    shared_->view.setFitted(PlotAxis::y, toPlotRange(shared_->figure.y.range));
}

bool FigurePlot::setTime(std::optional<double> t) {
    shared_->cursors.time = t;
    return moveCurves();
}

bool FigurePlot::moveCurves() {
    bool isAny = false;
    for (Series& s : shared_->figure.series()) {
        if (!s.moving) continue;
        const std::optional<double> t = shared_->cursors.time;
        const MovingCurve::Moment& now = t ? s.moving->at(*t) : s.moving->moments.back();
        s.x = now.x;
        s.y = now.y;
        isAny = true;
    }
    return isAny;
}

bool FigurePlot::setStale(bool isStale) { return std::exchange(shared_->isStale, isStale) != isStale; }
bool FigurePlot::setHighlighted(const QString& label) {
    return std::exchange(shared_->highlighted, label) != label;
}
void FigurePlot::setPrintDensity(double pointsPerPixel) { shared_->density = pointsPerPixel; }
void FigurePlot::setHidden(const QString& label, bool isHidden) {
    if (isHidden)
        shared_->hidden.insert(label);
    else
        shared_->hidden.remove(label);
}

const Figure& FigurePlot::figure() const { return shared_->figure; }
bool FigurePlot::isHidden(const QString& label) const { return shared_->hidden.contains(label); }
ViewState& FigurePlot::view() { return shared_->view; }
PlotCursors& FigurePlot::cursors() { return shared_->cursors; }
PixelMap FigurePlot::pixelMap() const { return shared_->map(); }

void FigurePlot::prepare(QSize size) {
    Shared& s = *shared_;
    const bool isSmall = size.width() < 360 || size.height() < 220;
    QCPAxis &x = *s.plot.xAxis, &y = *s.plot.yAxis;
    styleAxis(x, s.theme, isSmall);
    styleAxis(y, s.theme, isSmall);
    for (QCPAxis* axis : {&x, &y}) {
        axis->setTicks(s.figure.axes == AxisStyle::scales);
        axis->setTickLabels(s.figure.axes == AxisStyle::scales);
        if (s.figure.axes == AxisStyle::none) axis->setBasePen(Qt::NoPen);
    }
    const QFontMetricsF titles(x.labelFont());
    const bool isEmpty = !s.figure.message.empty();  // no ticks, and no room beside them
    const QString title = isEmpty ? QString() : QString::fromStdString(s.figure.y.title),
                  xTitle = isEmpty ? QString() : QString::fromStdString(s.figure.x.title);
    x.setLabel(titles.elidedText(plainTitle(xTitle), Qt::ElideRight, size.width() - 16));
    if (hasOwnParts(xTitle)) x.setLabelColor(Qt::transparent);  // drawn by its own layer
    if (hasOwnParts(title)) y.setLabelColor(Qt::transparent);
    x.setScaleType(s.figure.x.isLog ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
    y.setScaleType(s.figure.y.isLog ? QCPAxis::stLogarithmic : QCPAxis::stLinear);

    s.view.setFitted(PlotAxis::x, toPlotRange(s.figure.x.range));
    s.view.setFitted(PlotAxis::y, toPlotRange(s.figure.y.range));
    QMargins margins = s.plot.axisRect()->minimumMargins();
    margins.setRight(std::max(16, scaleWidth(s.figure, s.theme)));
    // Without room beside the axis, its title stands above the plot.
    const double below = QFontMetricsF(x.tickLabelFont()).height() + titles.height() + 14;
    s.isTitleAbove = titles.horizontalAdvance(title) > size.height() - 10 - below;
    y.setLabel(s.isTitleAbove ? QString() : plainTitle(title));
    // The uppermost number stands half above the plot.
    margins.setTop(8 + (s.isTitleAbove ? static_cast<int>(std::ceil(titles.height())) + 4 : 0));
    // Without labels of ticks the margin is too narrow for what hangs below the line.
    if (s.figure.axes != AxisStyle::scales && !xTitle.isEmpty())
        margins.setBottom(static_cast<int>(std::ceil(titles.height())) + 10);
    s.plot.axisRect()->setMinimumMargins(margins);
    const QRect before = s.plot.viewport();
    s.plot.setViewport(QRect(QPoint(0, 0), size));
    layOut(s, size.width() - 80, size.height() - 50);  // a guess, only to measure the margins
    const QRect rect = s.plot.axisRect()->rect();
    if (s.figure.aspect == Aspect::equal && rect.width() > 0 && rect.height() > 0)
        makeScalesEqual(s.view, rect.size());
    makeRoomForMarks(s, rect.height());
    layOut(s, rect.width(), rect.height());
    s.plot.setViewport(before);
}

namespace {

double distance(QPointF a, QPointF b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

/// Rows whose x lies within reach of a pixel; all rows of a curve, thinned to what a move of the pointer can
/// afford.
struct Rows {
    std::size_t from, to, step;
};

Rows rowsNear(const Series& s, const PixelMap& map, double pixel, double reach) {
    if (s.kind == SeriesKind::curve || hasMarks(s.kind))
        return {0, s.x.size(), std::max<std::size_t>(1, s.x.size() / 50000)};
    const auto low = std::lower_bound(s.x.begin(), s.x.end(), map.xAt(pixel - reach));
    const auto high = std::upper_bound(low, s.x.end(), map.xAt(pixel + reach));
    const auto from = static_cast<std::size_t>(low - s.x.begin()),
               to = static_cast<std::size_t>(high - s.x.begin());
    return {from > 0 ? from - 1 : 0, std::min(to + 1, s.x.size()),
            std::max<std::size_t>(1, (to - from) / 20000)};
}

}  // namespace

std::optional<FigurePlot::Hit> FigurePlot::hit(QPointF pixel, double reach) const {
    const PixelMap map = pixelMap();
    std::optional<Hit> best;
    for (std::size_t i = 0; i < shared_->figure.series().size(); ++i) {
        const Series& s = shared_->figure.series()[i];
        if (!shared_->isShown(s)) continue;
        const Rows rows = rowsNear(s, map, pixel.x(), reach);
        for (std::size_t r = rows.from; r < rows.to; r += rows.step) {
            const QPointF p = map(s.x[r], s.y[r]);
            const double d = distance(p, pixel);
            if (!(d <= reach) || !map.rect.adjusted(-2, -2, 2, 2).contains(p)) continue;
            if (!best || d < distance(best->at, pixel)) best = Hit{i, r, p};
        }
    }
    return best;
}

}  // namespace extremal
