// SPDX-License-Identifier: GPL-3.0-or-later
/// What the stage shows of a state, as plain shapes in the model's own coordinates; no graphics library here.
/// Planar systems draw in the plane z = 0, y up; systems in space (System::isSpatial) are seen from a corner,
/// y up.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace extremal {

using Point = std::array<double, 3>;

/// Who a shape belongs to: the scenery is drawn once, the rest once per scheme in the scheme's colour.
enum class ShapeRole { scenery, body };

struct Segment {  ///< a rod or an axis
    Point a, b;
    double width = 2;  ///< pixels
    ShapeRole role = ShapeRole::body;
};
struct Disc {  ///< a mass; always drawn round, of a size in pixels
    Point centre;
    double radius = 8;  ///< pixels
    ShapeRole role = ShapeRole::body;
};
struct Spring {  ///< a zigzag between two points, with short straight ends
    Point a, b;
    int coils = 12;
    ShapeRole role = ShapeRole::body;
};
struct Support {  ///< a hatched ceiling: a line with strokes on its upper side
    Point centre;
    double width = 1;  ///< model units
};
struct Solid {  ///< a convex body with flat faces, drawn shaded
    std::vector<Point> corners;
    std::vector<std::vector<int>> faces;  ///< corners of each, counterclockwise as seen from outside
    bool isSmooth =
        false;  ///< the faces stand for a curved surface: of their edges the outline alone is drawn
};
struct Word {  ///< the name of an axis, in the middle of this place; of bodies those of the first scheme
               ///< alone are shown
    Point centre;
    std::string text;
    ShapeRole role = ShapeRole::scenery;
};
struct Curtain {  ///< a field over a line: the area between its curve and the ground
    std::vector<Point> top;
    double ground = 0;         ///< y of the ground
    std::vector<double> hues;  ///< colours along the curve, in turns; empty: that of the scheme
};
struct Raster {    ///< a field over a rectangle, as colours at points that fill it to its edges, and mixed
                   ///< between them
    Point corner;  ///< the lower left one
    double width = 1, height = 1;
    int columns = 0, rows = 0;      ///< of points, at least two each
    std::vector<double> strengths;  ///< 0 (not seen) .. 1 at (column, row), column + row columns
    std::vector<double> hues;       ///< in turns; empty: grey
    ShapeRole role = ShapeRole::body;
};
struct Curve {  ///< a line through points
    std::vector<Point> points;
    double width = 1;     ///< pixels
    double strength = 1;  ///< 0 (not seen) .. 1
    ShapeRole role = ShapeRole::scenery;
};
using Shape = std::variant<Segment, Disc, Spring, Support, Solid, Word, Curtain, Raster, Curve>;

/// One state of one scheme as shapes, and the point whose path makes the trail.
struct Drawing {
    std::vector<Shape> shapes;
    Point tracer{};
    bool isTracerOnly = false;  ///< asked for its tracer alone: shapes may be left out
    void clear() {
        shapes.clear();
        tracer = {};
    }
};

/// A small picture in the corner of the stage, turned with it: a ball, and on it or near it a point for each
/// scheme whose path makes a second trail. What lies behind the middle of the ball is drawn faintly.
struct Inset {
    std::string title;                             ///< below it; empty: the system has no inset
    std::vector<Shape> backdrop;                   ///< in units of the ball's radius
    std::function<double(const double* x)> reach;  ///< the ball's radius in units of the tracer, at the start
    std::function<Point(const double* x)> tracer;
};

}  // namespace extremal
