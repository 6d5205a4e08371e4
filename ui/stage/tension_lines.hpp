// SPDX-License-Identifier: GPL-3.0-or-later
/// The forces in the rods of a mechanism, as colours along the rods of the stage: pulled or pressed.
#pragma once

#include <vector>

#include "ui/stage/stage_player.hpp"

namespace extremal {

struct TensionLine {
    Point a{}, b{};
    double pull =
        0;  ///< the force in the rod, positive where it is pulled, in parts of the largest of the run
};

/// At a time of the first scheme; empty where the run has no column "reaction.NAME" of a rod.
std::vector<TensionLine> tensionLines(const StagePlayer& player, double t);

}  // namespace extremal
