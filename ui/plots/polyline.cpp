// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/polyline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace extremal {
namespace {

double fraction(double value, PlotRange range, bool isLog) {
    if (!isLog) return (value - range.low) / (range.high - range.low);
    return std::log(value / range.low) / std::log(range.high / range.low);
}

double valueAt(double f, PlotRange range, bool isLog) {
    if (!isLog) return range.low + f * (range.high - range.low);
    return range.low * std::pow(range.high / range.low, f);
}

constexpr double farAway = 1e9;  // pixels; beyond, only the direction matters

/// The part of the segment a-b inside the rectangle (Liang and Barsky 1984): parameters in [0, 1], or none.
bool clip(const QRectF& rect, QPointF a, QPointF b, double& from, double& to) {
    from = 0;
    to = 1;
    const double dx = b.x() - a.x(), dy = b.y() - a.y();
    const std::array<std::array<double, 2>, 4> sides = {{{-dx, a.x() - rect.left()},
                                                         {dx, rect.right() - a.x()},
                                                         {-dy, a.y() - rect.top()},
                                                         {dy, rect.bottom() - a.y()}}};
    for (const auto& [p, q] : sides) {
        if (p == 0) {
            if (q < 0) return false;
            continue;
        }
        const double r = q / p;
        if (p < 0)
            from = std::max(from, r);
        else
            to = std::min(to, r);
        if (from > to) return false;
    }
    return true;
}

constexpr double clipMargin = 40;  // pixels around the plot

/// Of the points in one pixel column: the first, the lowest, the highest and the last, and how often the line
/// turned.
class PixelColumn {
public:
    explicit PixelColumn(QPointF p, bool startsPiece) : isStart(startsPiece) { add(p); }
    void add(QPointF p) {
        const Point point{p, count_++};
        if (point.order == 0) first_ = low_ = high_ = point;
        if (p.y() < low_.at.y()) low_ = point;
        if (p.y() > high_.at.y()) high_ = point;
        last_ = point;
    }
    double x() const { return first_.at.x(); }
    double top() const { return low_.at.y(); }
    double bottom() const { return high_.at.y(); }
    void appendTo(QPolygonF& line) const {
        const bool isLowFirst = low_.order < high_.order;
        int previous = -1;
        for (const Point& p : {first_, isLowFirst ? low_ : high_, isLowFirst ? high_ : low_, last_})
            if (p.order > previous) {
                line.push_back(p.at);
                previous = p.order;
            }
    }

    bool isStart;  ///< not joined to the column before
    int turns = 0;
    bool isDense = false;

private:
    struct Point {
        QPointF at;
        int order = 0;
    };
    int count_ = 0;
    Point first_, low_, high_, last_;
};

/// Sorts the points of a line into columns.
class PixelColumns {
public:
    explicit PixelColumns(double density) : density_(density) {}
    void add(QPointF p) {
        const double place = std::floor(p.x() * density_);
        if (columns_.empty() || isCut_ || place != place_)
            columns_.emplace_back(p, isCut_);
        else
            columns_.back().add(p);
        isCut_ = false;
        place_ = place;
        countTurns(p.y());
    }
    /// The next point is not joined to the last one.
    void cut() { isCut_ = true; }
    std::vector<PixelColumn>& all() { return columns_; }

private:
    /// A turn is where the line comes back by more than a pixel.
    void countTurns(double y) {
        constexpr double least = 1;
        if (columns_.size() == 1 && direction_ == 0 && !isStarted_) {
            extreme_ = y;
            isStarted_ = true;
        }
        const double away = y - extreme_;
        if (direction_ * away >= 0 && (direction_ != 0 || std::abs(away) > least)) {
            if (direction_ == 0) direction_ = away > 0 ? 1 : -1;
            extreme_ = y;
        } else if (direction_ != 0 && std::abs(away) > least) {
            direction_ = -direction_;
            extreme_ = y;
            ++columns_.back().turns;
        }
    }
    double density_, place_ = 0;
    std::vector<PixelColumn> columns_;
    bool isCut_ = true, isStarted_ = false;
    int direction_ = 0;
    double extreme_ = 0;
};

/// Marks the columns that belong to bands: where, over a window, the line turns at least once per two pixels
/// and is some pixels high, if it turns twice per three pixels somewhere there. Bands that are narrow stay
/// lines, and narrow gaps in bands are closed.
void markDense(std::vector<PixelColumn>& columns) {
    constexpr double window = 6, leastHeight = 4, leastWidth = 24;  // pixels
    constexpr double manyTurns = 0.66, someTurns = 0.4;             // per pixel
    std::vector<bool> isCore(columns.size());
    std::size_t from = 0, to = 0;
    double turns = 0, height = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        PixelColumn& column = columns[i];
        for (; to < columns.size() && columns[to].x() <= column.x() + window; ++to) {
            turns += columns[to].turns;
            height += columns[to].bottom() - columns[to].top();
        }
        for (; columns[from].x() < column.x() - window; ++from) {
            turns -= columns[from].turns;
            height -= columns[from].bottom() - columns[from].top();
        }
        const double width = std::min(column.x() + window, columns.back().x()) -
                             std::max(column.x() - window, columns.front().x());
        const bool isHigh = width > 0 && height >= leastHeight * static_cast<double>(to - from);
        column.isDense = isHigh && turns >= someTurns * width;
        isCore[i] = isHigh && turns >= manyTurns * width;
    }
    for (std::size_t i = 0; i < columns.size();) {
        std::size_t end = i;
        bool hasCore = false;
        for (; end < columns.size() && columns[end].isDense == columns[i].isDense; ++end)
            hasCore = hasCore || isCore[end];
        for (std::size_t k = i; k < end && !hasCore; ++k) columns[k].isDense = false;
        i = end;
    }
    const auto flipRuns = [&](bool isDense) {
        for (std::size_t i = 0; i < columns.size();) {
            std::size_t end = i;
            while (end < columns.size() && columns[end].isDense == columns[i].isDense) ++end;
            const bool isAtEnd = i == 0 || end == columns.size();
            if (columns[i].isDense == isDense && columns[end - 1].x() - columns[i].x() < leastWidth &&
                (isDense || !isAtEnd))
                for (std::size_t k = i; k < end; ++k) columns[k].isDense = !isDense;
            i = end;
        }
    };
    flipRuns(false);
    flipRuns(true);
}

/// The extremes over the columns of a band and their neighbours up to two pixels away: a whole oscillation
/// each.
VisibleLine::Band bandOf(std::span<const PixelColumn> columns) {
    constexpr double reach = 2;
    VisibleLine::Band band;
    std::size_t from = 0, to = 0;
    for (const PixelColumn& column : columns) {
        while (to < columns.size() && columns[to].x() <= column.x() + reach) ++to;
        while (columns[from].x() < column.x() - reach) ++from;
        double top = column.top(), bottom = column.bottom();
        for (std::size_t k = from; k < to; ++k) {
            top = std::min(top, columns[k].top());
            bottom = std::max(bottom, columns[k].bottom());
        }
        band.upper.push_back({column.x(), top});
        band.lower.push_back({column.x(), bottom});
    }
    return band;
}

VisibleLine assemble(std::vector<PixelColumn>& columns) {
    markDense(columns);
    VisibleLine visible;
    QPolygonF line;
    const auto end = [&] {
        if (!line.isEmpty()) visible.lines.push_back(std::move(line));
        line = {};
    };
    for (std::size_t i = 0; i < columns.size();) {
        if (!columns[i].isDense) {
            if (columns[i].isStart) end();
            columns[i++].appendTo(line);
            continue;
        }
        if (!columns[i].isStart && !line.isEmpty()) columns[i].appendTo(line);  // no gap before the band
        end();
        const std::size_t first = i;
        while (i < columns.size() && columns[i].isDense) ++i;
        visible.bands.push_back(bandOf(std::span(columns).subspan(first, i - first)));
        if (i < columns.size() && !columns[i].isStart) columns[i - 1].appendTo(line);
    }
    end();
    return visible;
}

/// Drops points too close to the last one kept, but keeps the end.
QPolygonF spaced(const QPolygonF& in, double distance) {
    if (in.size() < 3) return in;
    QPolygonF out;
    out.push_back(in.front());
    for (const QPointF& p : in) {
        const QPointF d = p - out.back();
        if (QPointF::dotProduct(d, d) >= distance * distance) out.push_back(p);
    }
    if (out.back() != in.back()) out.push_back(in.back());
    return out;
}

/// Calls `add(point)` for what of a polyline is inside the plot and its margin, and `cut()` where a piece
/// ends; with `isWhole` only gaps end pieces, and what leaves the margin goes along it.
template <class Add, class Cut>
void clipLine(std::span<const double> x, std::span<const double> y, const PixelMap& map, bool isWhole,
              const Add& add, const Cut& cut) {
    const QRectF outer = map.rect.adjusted(-clipMargin, -clipMargin, clipMargin, clipMargin);
    const double left = outer.left(), right = outer.right(), top = outer.top(), bottom = outer.bottom();
    QPointF previous;
    bool hasPrevious = false, isOpen = false;  // open: the piece ends in `previous`
    bool wasInside = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const QPointF p = map(x[i], y[i]);
        if (std::isnan(p.x()) || std::isnan(p.y())) {
            if (hasPrevious && !isOpen && outer.contains(previous)) add(previous);  // a lonely point
            cut();
            hasPrevious = isOpen = wasInside = false;
            continue;
        }
        const bool isInside = p.x() >= left && p.x() <= right && p.y() >= top && p.y() <= bottom;
        double from = 0, to = 1;
        if (isOpen && wasInside && isInside) {  // nearly all points of a long run
            add(p);
        } else if (hasPrevious && clip(outer, previous, p, from, to)) {
            if (!isOpen || from > 0) {
                if (!isWhole) cut();
                add(previous + from * (p - previous));
            }
            add(to < 1 ? previous + to * (p - previous) : p);
            isOpen = to >= 1;
        } else {
            isOpen = false;
        }
        previous = p;
        hasPrevious = true;
        wasInside = isInside;
    }
    if (hasPrevious && !isOpen && outer.contains(previous)) add(previous);
}

/// The rows of a monotone x that a plot needs: those inside it, and the neighbours on both sides.
std::pair<std::size_t, std::size_t> rowsInside(std::span<const double> x, const PixelMap& map) {
    constexpr std::size_t few = 1000;
    if (x.size() < few || std::any_of(x.begin(), x.end(), [](double v) { return std::isnan(v); }))
        return {0, x.size()};
    const double low = map.xAt(map.rect.left() - clipMargin), high = map.xAt(map.rect.right() + clipMargin);
    const bool isRising = x.back() > x.front();
    const auto before = [&](double a, double b) { return isRising ? a < b : a > b; };
    const auto first = std::lower_bound(x.begin(), x.end(), isRising ? low : high, before);
    const auto last = std::upper_bound(first, x.end(), isRising ? high : low, before);
    const auto from = static_cast<std::size_t>(first - x.begin()),
               to = static_cast<std::size_t>(last - x.begin());
    return {from > 0 ? from - 1 : 0, std::min(to + 1, x.size())};
}

/// Without points closer than the distance to the last one kept, but for the ends of pieces.
std::vector<QPolygonF> clippedPieces(std::span<const double> x, std::span<const double> y,
                                     const PixelMap& map, double distance) {
    std::vector<QPolygonF> pieces;
    QPolygonF piece;
    std::optional<QPointF> left;  // the last point, where it was left out
    const auto cut = [&] {
        if (left && *left != piece.back()) piece.push_back(*left);
        left.reset();
        if (!piece.isEmpty()) pieces.push_back(std::move(piece));
        piece = {};
    };
    const auto add = [&](QPointF p) {
        if (!piece.isEmpty()) {
            const QPointF d = p - piece.back();
            if (QPointF::dotProduct(d, d) < distance * distance) {
                left = p;
                return;
            }
        }
        piece.push_back(p);
        left.reset();
    };
    clipLine(x, y, map, false, add, cut);
    cut();
    return pieces;
}

double lengthOf(const QPolygonF& line) {
    double length = 0;
    for (qsizetype i = 1; i < line.size(); ++i) {
        const QPointF d = line[i] - line[i - 1];
        length += std::sqrt(QPointF::dotProduct(d, d));  // pixels: nothing overflows
    }
    return length;
}

}  // namespace

QPointF PixelMap::operator()(double xValue, double yValue) const {
    const double fx = fraction(xValue, x, isXLog), fy = fraction(yValue, y, isYLog);
    return {std::clamp(rect.left() + fx * rect.width(), -farAway, farAway),
            std::clamp(rect.bottom() - fy * rect.height(), -farAway, farAway)};
}

double PixelMap::xAt(double pixel) const { return valueAt((pixel - rect.left()) / rect.width(), x, isXLog); }

double PixelMap::yAt(double pixel) const {
    return valueAt((rect.bottom() - pixel) / rect.height(), y, isYLog);
}

VisibleLine visibleLine(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                        double density) {
    PixelColumns columns(density);
    const auto [from, to] = rowsInside(x, map);
    clipLine(
        x.subspan(from, to - from), y.subspan(from, to - from), map, true, [&](QPointF p) { columns.add(p); },
        [&] { columns.cut(); });
    return assemble(columns.all());
}

VisibleLine visibleCurve(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                         double density) {
    VisibleLine visible;
    constexpr double closest = 0.5, farthest = 4, growth = 1.5;  // pixels between points
    const double most = 20000 * density;
    double distance = closest / density, length = 0;
    visible.lines = clippedPieces(x, y, map, distance);
    qsizetype count = 0;
    for (const QPolygonF& piece : visible.lines) {
        count += piece.size();
        length += lengthOf(piece);
    }
    if (static_cast<double>(count) > most) {
        // About as many points remain as the distance goes into the length.
        while (length / distance > most && distance <= farthest) distance *= growth;
        for (QPolygonF& piece : visible.lines) piece = spaced(piece, distance);
    }
    // With so much line in the plot dashes are not seen.
    visible.isDense = length > 0.25 * map.rect.width() * map.rect.height();
    return visible;
}

VisibleLine visibleSamples(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                           bool isCurve, double density) {
    VisibleLine visible;
    if (!isCurve) visible.bands = visibleLine(x, y, map, density).bands;
    const QRectF near = map.rect.adjusted(-3, -3, 3, 3);
    std::set<std::pair<int, int>> taken;  // places of half a pixel
    for (std::size_t i = 0; i < x.size(); ++i) {
        const QPointF p = map(x[i], y[i]);
        // A rectangle "contains" what is not a number.
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !near.contains(p)) continue;
        const bool isInBand =
            std::any_of(visible.bands.begin(), visible.bands.end(), [&](const VisibleLine::Band& band) {
                return p.x() >= band.upper.front().x() && p.x() <= band.upper.back().x();
            });
        const double fine = 2 * density;
        if (!isInBand && taken.emplace(std::lround(p.x() * fine), std::lround(p.y() * fine)).second)
            visible.dots.push_back(p);
    }
    return visible;
}

double strokedLength(const VisibleLine& visible) {
    double length = 0;
    for (const QPolygonF& line : visible.lines) length += lengthOf(line);
    for (const VisibleLine::Band& band : visible.bands) length += lengthOf(band.upper) + lengthOf(band.lower);
    return length;
}

}  // namespace extremal
