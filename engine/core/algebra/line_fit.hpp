// SPDX-License-Identifier: GPL-3.0-or-later
/// The least-squares line y = constant + slope x through points.
#pragma once

#include <limits>
#include <span>

namespace extremal {

struct LineFit {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    double slope = unknown, constant = unknown;
    double r2 = unknown;     ///< coefficient of determination; 0 where all y are equal
    double worst = unknown;  ///< largest distance of a point from the line, along y
};

/// Points whose y is not finite are left out. Unknown of fewer than two points, or if all x are equal.
LineFit lineThrough(std::span<const double> x, std::span<const double> y);

/// The same line through points that come one by one and are not kept: means and moments are updated, so that
/// nothing cancels over long runs (Welford 1962).
class RunningLine {
public:
    void add(double x, double y) {
        ++n_;
        const double dx = x - meanX_, dy = y - meanY_;
        meanX_ += dx / n_;
        meanY_ += dy / n_;
        xx_ += dx * (x - meanX_);
        xy_ += dx * (y - meanY_);
        yy_ += dy * (y - meanY_);
    }
    double points() const { return n_; }
    /// Unknown of fewer than two points, or if all x are equal.
    double slope() const { return n_ >= 2 && xx_ > 0 ? xy_ / xx_ : LineFit::unknown; }
    /// Standard deviation of the points from the line; unknown of fewer than three.
    double scatter() const;
    template <class Archive>
    void checkpoint(Archive& archive) {
        archive(n_, meanX_, meanY_, xx_, xy_, yy_);
    }

private:
    double n_ = 0, meanX_ = 0, meanY_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

}  // namespace extremal
