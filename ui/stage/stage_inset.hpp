// SPDX-License-Identifier: GPL-3.0-or-later
/// The small picture in the corner of the stage, put into the large one.
///
/// Every point of it is mapped by one similarity without rotation, r -> C + s r, into the coordinates of the
/// large picture, so that the same strokes draw both; s and C follow from the camera such that it stays in
/// its corner at its size, and turns with the camera.
#pragma once

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

class InsetPlace {
public:
    /// `width` and `height` of the picture in logical pixels.
    InsetPlace(const StageFrame& frame, const Camera& camera, double width, double height);

    /// Where the ball is, in the model coordinates of the large picture, and its radius there.
    const Point& centre() const { return centre_; }
    double radius() const { return radius_; }
    Point map(const Point& r) const;
    Shape map(Shape shape) const;
    std::vector<TrailPoint> map(std::vector<TrailPoint> trail) const;

    /// Pixels: the ball's radius, and what the corner takes of the width, or of the height of pictures that
    /// are tall.
    static double pixels(double width, double height);
    static double corner(double width, double height);

private:
    Point centre_{};
    double radius_ = 1, scale_ = 1;
};

}  // namespace extremal
