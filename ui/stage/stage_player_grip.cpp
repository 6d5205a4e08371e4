// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies under the pointer.
#include <algorithm>
#include <cmath>

#include "ui/stage/body_drag.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {

std::optional<StagePlayer::Grip> StagePlayer::gripAt(double t, const Camera& camera, double x, double y,
                                                     double reach) const {
    if (!hasStage() || !hasMovableBodies(system_)) return {};
    std::optional<Grip> nearest;
    double least = 0;
    for (const Track& track : tracks_) {
        if (track.system || (track.hasFailed && t > track.t.back())) continue;
        Grip grip;
        stateAt(track, t, grip.x);
        Drawing drawing;
        system_.draw(grip.x.data(), drawing);
        for (std::size_t k = 0; k < drawing.shapes.size(); ++k) {
            const auto* disc = std::get_if<Disc>(&drawing.shapes[k]);
            if (!disc || disc->role != ShapeRole::body) continue;
            const Point seen = camera.project(disc->centre);
            const double away = std::max(0.0, std::hypot(seen[0] - x, seen[1] - y) - disc->radius);
            if (away > reach || (nearest && away >= least)) continue;
            least = away;
            nearest = grip;
            nearest->shape = k;
            nearest->place = disc->centre;
        }
    }
    return nearest;
}

}  // namespace extremal
