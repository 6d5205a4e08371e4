// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies under the pointer.
#include <algorithm>
#include <cmath>

#include "ui/stage/body_drag.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {

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
            if (!disc || disc->role != ShapeRole::body) continue;
            Point place = disc->centre;
            for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += grip.offset[axis];
            const Point seen = camera.project(place);
            const double away = std::max(0.0, std::hypot(seen[0] - x, seen[1] - y) - disc->radius);
            if (away > reach || (nearest && away >= least)) continue;
            least = away;
            nearest = grip;
            nearest->shape = k;
            nearest->place = place;
        }
    }
    return nearest;
}

}  // namespace extremal
