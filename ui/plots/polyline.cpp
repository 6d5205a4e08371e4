#include "ui/plots/polyline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

/// First, lowest, highest and last point of each pixel column, in their order.
class ColumnThinner {
public:
    explicit ColumnThinner(double density) : density_(density) {}
    void add(QPolygonF& out, QPointF p) {
        const double column = std::floor(p.x() * density_);
        if (count_ > 0 && column != column_) flush(out);
        column_ = column;
        const Point point{p, count_++};
        if (point.order == 0) first_ = low_ = high_ = point;
        if (p.y() < low_.at.y()) low_ = point;
        if (p.y() > high_.at.y()) high_ = point;
        last_ = point;
    }
    void flush(QPolygonF& out) {
        if (count_ == 0) return;
        const bool isLowFirst = low_.order < high_.order;
        int previous = -1;
        for (const Point& p : {first_, isLowFirst ? low_ : high_, isLowFirst ? high_ : low_, last_})
            if (p.order > previous) {
                out.push_back(p.at);
                previous = p.order;
            }
        count_ = 0;
    }

private:
    struct Point {
        QPointF at;
        int order = 0;
    };
    double density_, column_ = 0;
    int count_ = 0;
    Point first_, low_, high_, last_;
};

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

std::vector<QPolygonF> clipped(std::span<const double> x, std::span<const double> y, const PixelMap& map,
                               ColumnThinner* thinner) {
    const QRectF outer = map.rect.adjusted(-40, -40, 40, 40);
    std::vector<QPolygonF> pieces;
    QPolygonF piece;
    const auto add = [&](QPointF p) { thinner ? thinner->add(piece, p) : piece.push_back(p); };
    const auto end = [&] {
        if (thinner) thinner->flush(piece);
        if (!piece.isEmpty()) pieces.push_back(std::move(piece));
        piece = {};
    };
    QPointF previous;
    bool hasPrevious = false, isOpen = false;  // open: the piece ends in `previous`
    for (std::size_t i = 0; i < x.size(); ++i) {
        const QPointF p = map(x[i], y[i]);
        if (std::isnan(p.x()) || std::isnan(p.y())) {
            if (hasPrevious && !isOpen && outer.contains(previous)) add(previous);  // a lonely point
            end();
            hasPrevious = isOpen = false;
            continue;
        }
        double from = 0, to = 1;
        if (hasPrevious && clip(outer, previous, p, from, to)) {
            if (!isOpen || from > 0) {
                end();
                add(previous + from * (p - previous));
            }
            add(to < 1 ? previous + to * (p - previous) : p);
            isOpen = to >= 1;
        } else {
            isOpen = false;
        }
        previous = p;
        hasPrevious = true;
    }
    if (hasPrevious && !isOpen && pieces.empty() && piece.isEmpty() && outer.contains(previous))
        add(previous);
    end();
    return pieces;
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

std::vector<QPolygonF> visiblePolylines(std::span<const double> x, std::span<const double> y,
                                        const PixelMap& map, bool isCurve, double density) {
    ColumnThinner thinner(density);
    std::vector<QPolygonF> pieces = clipped(x, y, map, isCurve ? nullptr : &thinner);
    if (!isCurve) return pieces;
    for (double distance = 0.5 / density;; distance *= 1.5) {
        qsizetype count = 0;
        for (QPolygonF& piece : pieces) count += (piece = spaced(piece, distance)).size();
        if (count <= static_cast<qsizetype>(20000 * density) || distance > 4) return pieces;
    }
}

}  // namespace extremal
