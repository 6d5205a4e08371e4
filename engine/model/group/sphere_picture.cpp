// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "engine/model/body/rigid.hpp"
#include "engine/model/group/sphere_picture.hpp"
#include "engine/model/group/sphere_system.hpp"

namespace extremal::spheres {
namespace {

/// One circle of a net, at `height` along an axis.
Curve circle(int axis, double height, double strength) {
    Curve curve;
    curve.strength = strength;
    curve.role = ShapeRole::scenery;
    const double radius = std::sqrt(1 - height * height);
    for (int k = 0; k <= 72; ++k) {
        const double angle = k * std::numbers::pi / 36;
        std::array<double, 3> p{};
        const auto a = static_cast<std::size_t>(axis);
        p[a] = height;
        p[(a + 1) % 3] = radius * std::cos(angle);
        p[(a + 2) % 3] = radius * std::sin(angle);
        curve.points.push_back(onStage(p[0], p[1], p[2]));
    }
    return curve;
}

}  // namespace

void drawSphere(Drawing& drawing) {
    for (const double height : {-0.75, -0.4, 0.0, 0.4, 0.75})
        drawing.shapes.push_back(circle(2, height, height == 0 ? 0.5 : 0.25));
    for (const int axis : {0, 1}) drawing.shapes.push_back(circle(axis, 0, 0.25));
}

void describePicture(System& s, const Spheres& on) {
    s.isSpatial = true;
    const std::size_t count = on.names.size();
    // One point lies on its sphere; several hang from each other.
    s.draw = [count](const double* x, Drawing& drawing) {
        Point at = onStage(0, 0, 0), sum{};
        if (!drawing.isTracerOnly && count == 1) drawSphere(drawing);
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t i = 0; i < 3; ++i) sum[i] += x[3 * k + i];
            const Point next = onStage(sum[0], sum[1], sum[2]);
            if (!drawing.isTracerOnly) {
                drawing.shapes.push_back(Segment{at, next, 2});
                drawing.shapes.push_back(Disc{next, 7});
            }
            at = next;
        }
        drawing.tracer = at;
    };
}

}  // namespace extremal::spheres
