// SPDX-License-Identifier: GPL-3.0-or-later
/// The clocks of the elements of asynchronous schemes, on the stage while it plays.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/stage/stage_player.hpp"

namespace extremal {

/// Below the picture of a field over a line.
void StagePlayer::makeRoomForClocks() {
    const bool hasClocks = std::any_of(tracks_.begin(), tracks_.end(), [](const Track& track) {
        const ElementClocks* const clocks = track.result->products.find<ElementClocks>();
        return clocks && !clocks->x.empty();
    });
    if (!hasClocks || isSpatial() || bounds_.isEmpty) return;
    const double height =
        std::max(bounds_.high[1] - bounds_.low[1], 0.2 * (bounds_.high[0] - bounds_.low[0]));
    clockTop_ = bounds_.low[1] - 0.05 * height;
    clockGround_ = clockTop_ - 0.25 * height;
    bounds_.low[1] = clockGround_;
}

/// How often each element of an asynchronous scheme has acted by now: those with the shortest steps fill the
/// band at the end.
void StagePlayer::addClocks(const Track& track, double t, StageLayer& layer) const {
    const ElementClocks* const clocks = track.result->products.find<ElementClocks>();
    if (!clocks || clocks->x.empty() || clockTop_ == clockGround_) return;
    const double most = *std::max_element(clocks->updates.begin(), clocks->updates.end()),
                 since = std::min(t, track.t.back()) - track.t.front();
    if (!(most > 0)) return;
    Curtain curtain;
    curtain.ground = clockGround_;
    for (std::size_t e = 0; e < clocks->x.size(); ++e) {
        const double updates = std::clamp(std::floor(since / clocks->step[e] + 0.5), 0.0, clocks->updates[e]);
        curtain.top.push_back({clocks->x[e], clockGround_ + (clockTop_ - clockGround_) * updates / most, 0});
    }
    layer.shapes.push_back(std::move(curtain));
}

}  // namespace extremal
