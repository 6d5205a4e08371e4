// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_inset.hpp"

#include <algorithm>

namespace extremal {
namespace {

constexpr double captionHeight = 18;  // of the title below the ball

}  // namespace

double InsetPlace::pixels(double width, double height) {
    return std::clamp(std::min(0.13 * width, 0.28 * height), 20.0, 110.0);
}

double InsetPlace::corner(double width, double height) { return 2.9 * pixels(width, height); }

InsetPlace::InsetPlace(const StageFrame& frame, const Camera& camera, double width, double height) {
    const double r = pixels(width, height), away = corner(width, height) / 2;
    centre_ = camera.unproject(width / 2 - away, away - height / 2 + captionHeight);
    radius_ = r / camera.pixelsPerUnit;
    scale_ = radius_ / frame.inset->reach;
}

Point InsetPlace::map(const Point& r) const {
    return {centre_[0] + scale_ * r[0], centre_[1] + scale_ * r[1], centre_[2] + scale_ * r[2]};
}

Shape InsetPlace::map(Shape shape) const {
    if (auto* segment = std::get_if<Segment>(&shape)) {
        segment->a = map(segment->a);
        segment->b = map(segment->b);
    }
    if (auto* disc = std::get_if<Disc>(&shape)) disc->centre = map(disc->centre);
    if (auto* word = std::get_if<Word>(&shape)) word->centre = map(word->centre);
    if (auto* curve = std::get_if<Curve>(&shape))
        for (Point& p : curve->points) p = map(p);
    return shape;
}

std::vector<TrailPoint> InsetPlace::map(std::vector<TrailPoint> trail) const {
    for (TrailPoint& p : trail) p.r = map(p.r);
    return trail;
}

}  // namespace extremal
