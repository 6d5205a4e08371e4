// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies under the pointer.
#include <algorithm>
#include <cmath>

#include "ui/stage/body_drag.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {
namespace {

struct Held {
    std::size_t corner = 0;
    double away = HUGE_VAL;  ///< pixels
};

/// The nearest corner of the face that is seen at a pixel: its corners are counterclockwise there.
Held heldAt(const Solid& solid, const Camera& camera, const Point& offset, double x, double y) {
    std::vector<Point> seen;
    for (Point corner : solid.corners) {
        for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += offset[axis];
        seen.push_back(camera.project(corner));
    }
    for (const std::vector<int>& face : solid.faces) {
        bool isInside = true;
        Held held{0, 0};
        double least = HUGE_VAL;
        for (std::size_t k = 0; k < face.size(); ++k) {
            const auto at = static_cast<std::size_t>(face[k]),
                       next = static_cast<std::size_t>(face[(k + 1) % face.size()]);
            const Point &a = seen[at], &b = seen[next];
            isInside = isInside && (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) > 0;
            const double away = std::hypot(a[0] - x, a[1] - y);
            if (away < least) held.corner = at;
            least = std::min(least, away);
        }
        if (isInside) return held;
    }
    return {};
}

}  // namespace

std::optional<StagePlayer::Grip> StagePlayer::gripAt(double t, const Camera& camera, double x, double y,
                                                     double reach, const StageTiling& tiling) const {
    if (!hasStage() || !hasMovableBodies(system_)) return {};
    std::optional<Grip> nearest;
    double least = 0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
        const Track& track = tracks_[i];
        if (track.system || (track.hasFailed && t > track.t.back())) continue;
        Grip grip;
        grip.offset = tiling.offset(i);
        stateAt(track, t, grip.x);
        Drawing drawing;
        system_.draw(grip.x.data(), drawing);
        for (std::size_t k = 0; k < drawing.shapes.size(); ++k) {
            const auto* disc = std::get_if<Disc>(&drawing.shapes[k]);
            const auto* solid = std::get_if<Solid>(&drawing.shapes[k]);
            if (!solid && (!disc || disc->role != ShapeRole::body)) continue;
            Held held;
            if (solid) held = heldAt(*solid, camera, grip.offset, x, y);
            grip.held = {k, held.corner};
            const std::optional<Point> point = grip.held.in(drawing);
            if (!point) continue;
            for (std::size_t axis = 0; axis < 3; ++axis)
                grip.place[axis] = (*point)[axis] + grip.offset[axis];
            const Point seen = camera.project(grip.place);
            // A disc is drawn over the solid that it is on.
            const double away =
                disc ? std::max(0.0, std::hypot(seen[0] - x, seen[1] - y) - disc->radius) : held.away;
            if (away > reach || (nearest && (disc ? away > least : away >= least))) continue;
            least = away;
            nearest = grip;
        }
    }
    return nearest;
}

}  // namespace extremal
