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

}  // namespace extremal
