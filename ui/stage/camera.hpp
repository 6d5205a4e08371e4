// SPDX-License-Identifier: GPL-3.0-or-later
/// How the stage is looked at: an orthographic camera that orbits a point of the scene.
///
/// Screen coordinates of a model point r, in logical pixels from the middle of the picture, x right and y up:
///     (right . (r - centre), up . (r - centre)) * pixelsPerUnit
/// where (right, up, towards) are the rows of the rotation by azimuth about y, then by elevation about x.
/// Planar systems keep both angles at zero and look along -z.
#pragma once

#include <array>

#include "engine/model/drawing.hpp"

namespace extremal {

/// The smallest box, parallel to the axes, around what is to be seen.
struct Bounds {
    Point low{}, high{};
    bool isEmpty = true;

    void add(const Point& p);
    void add(const Bounds& other);
    double diagonal() const;
    bool operator==(const Bounds&) const = default;
};

inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Camera {
    Point centre{};
    double pixelsPerUnit = 100;
    double azimuth = 0, elevation = 0;  ///< rad

    /// Rows: right, up, towards the viewer.
    std::array<Point, 3> axes() const;
    /// Pixels from the middle, y up; the third entry grows towards the viewer.
    Point project(const Point& r) const;
    /// The same with the rows of axes(), which many points share.
    Point project(const Point& r, const std::array<Point, 3>& rows) const;
    /// The point of the plane through the centre that is seen at this pixel.
    Point unproject(double x, double y) const;
    bool operator==(const Camera&) const = default;
};

/// The camera that shows all of `bounds` in a picture of width x height logical pixels with this margin.
Camera fitCamera(const Bounds& bounds, double width, double height, double margin, double azimuth = 0,
                 double elevation = 0);

}  // namespace extremal
