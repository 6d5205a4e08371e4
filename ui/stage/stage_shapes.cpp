// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_shapes.hpp"

namespace extremal {
namespace {

void move(Point& p, const Point& by) {
    for (std::size_t i = 0; i < 3; ++i) p[i] += by[i];
}
void move(std::vector<Point>& points, const Point& by) {
    for (Point& p : points) move(p, by);
}

}  // namespace

Camera cornerView() {
    Camera camera;
    camera.pixelsPerUnit = 1;
    camera.azimuth = 0.55;
    camera.elevation = 0.32;
    return camera;
}

bool isScenery(const Shape& shape) {
    if (const auto* segment = std::get_if<Segment>(&shape)) return segment->role == ShapeRole::scenery;
    if (const auto* spring = std::get_if<Spring>(&shape)) return spring->role == ShapeRole::scenery;
    if (const auto* disc = std::get_if<Disc>(&shape)) return disc->role == ShapeRole::scenery;
    if (const auto* word = std::get_if<Word>(&shape)) return word->role == ShapeRole::scenery;
    if (const auto* curve = std::get_if<Curve>(&shape)) return curve->role == ShapeRole::scenery;
    if (const auto* raster = std::get_if<Raster>(&shape)) return raster->role == ShapeRole::scenery;
    if (std::holds_alternative<Solid>(shape) || std::holds_alternative<Curtain>(shape)) return false;
    return true;
}

Shape movedBy(Shape shape, const Point& by) {
    if (auto* const segment = std::get_if<Segment>(&shape)) {
        move(segment->a, by);
        move(segment->b, by);
    } else if (auto* const spring = std::get_if<Spring>(&shape)) {
        move(spring->a, by);
        move(spring->b, by);
    } else if (auto* const disc = std::get_if<Disc>(&shape)) {
        move(disc->centre, by);
    } else if (auto* const support = std::get_if<Support>(&shape)) {
        move(support->centre, by);
    } else if (auto* const solid = std::get_if<Solid>(&shape)) {
        move(solid->corners, by);
    } else if (auto* const word = std::get_if<Word>(&shape)) {
        move(word->centre, by);
    } else if (auto* const curtain = std::get_if<Curtain>(&shape)) {
        move(curtain->top, by);
        curtain->ground += by[1];
    } else if (auto* const raster = std::get_if<Raster>(&shape)) {
        move(raster->corner, by);
    } else if (auto* const curve = std::get_if<Curve>(&shape)) {
        move(curve->points, by);
    }
    return shape;
}

}  // namespace extremal
