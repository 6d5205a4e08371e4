// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/camera.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

void Bounds::add(const Point& p) {
    if (isEmpty) {
        low = high = p;
        isEmpty = false;
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
    }
}

void Bounds::add(const Bounds& other) {
    if (other.isEmpty) return;
    add(other.low);
    add(other.high);
}

double Bounds::diagonal() const {
    const Point d = minus(high, low);
    return std::sqrt(dot(d, d));
}

std::array<Point, 3> Camera::axes() const {
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    return {{{ca, 0, -sa}, {-sa * se, ce, -ca * se}, {sa * ce, se, ca * ce}}};
}

Point Camera::project(const Point& r) const { return project(r, axes()); }

Point Camera::project(const Point& r, const std::array<Point, 3>& rows) const {
    const Point d = minus(r, centre);
    return {dot(rows[0], d) * pixelsPerUnit, dot(rows[1], d) * pixelsPerUnit,
            dot(rows[2], d) * pixelsPerUnit};
}

Point Camera::unproject(double x, double y) const {
    const auto rows = axes();
    Point r = centre;
    for (std::size_t i = 0; i < 3; ++i) r[i] += (rows[0][i] * x + rows[1][i] * y) / pixelsPerUnit;
    return r;
}

Camera fitCamera(const Bounds& bounds, double width, double height, double margin, double azimuth,
                 double elevation) {
    Camera camera;
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    if (bounds.isEmpty) return camera;
    for (std::size_t i = 0; i < 3; ++i) camera.centre[i] = bounds.low[i] / 2 + bounds.high[i] / 2;
    const auto rows = camera.axes();
    double extent[2] = {0, 0};  // half of what is seen along right and up
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            extent[k] += std::abs(rows[k][i]) * (bounds.high[i] / 2 - bounds.low[i] / 2);
    const double halfWidth = std::max(width / 2 - margin, width / 4);
    const double halfHeight = std::max(height / 2 - margin, height / 4);
    const double tiny = 1e-12 * (1 + std::abs(camera.centre[0]) + std::abs(camera.centre[1]));
    if (extent[0] <= tiny && extent[1] <= tiny) extent[0] = extent[1] = 1;
    camera.pixelsPerUnit =
        std::min(halfWidth / std::max(extent[0], tiny), halfHeight / std::max(extent[1], tiny));
    return camera;
}

}  // namespace extremal
