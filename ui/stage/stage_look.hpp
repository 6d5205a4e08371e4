// SPDX-License-Identifier: GPL-3.0-or-later
/// How a stage shows a comparison: the schemes on top of each other or beside each other, how far the trails
/// go back, and whether the potential is behind them.
#pragma once

#include <cstddef>

#include "engine/model/drawing.hpp"

namespace extremal {

/// How far the trails go back.
enum class StageTrails {
    fading,  ///< as far as shows where the motion comes from
    longer,  ///< ten times as far
    whole,   ///< to the start
};

/// Schemes beside each other: scheme i is moved to its place in a grid, row by row from the top.
struct StageTiling {
    int columns = 1, rows = 1;
    Point right{1, 0, 0}, up{0, 1, 0};  ///< of the picture, in the model
    double width = 0, height = 0;       ///< of a place, in units of the model

    bool isOne() const { return columns * rows <= 1; }
    /// By which scheme i is moved.
    Point offset(std::size_t i) const {
        if (isOne()) return {};
        const auto place = static_cast<int>(i);
        const double x = width * (place % columns - (columns - 1) / 2.0),
                     y = height * ((rows - 1) / 2.0 - place / columns);
        return {x * right[0] + y * up[0], x * right[1] + y * up[1], x * right[2] + y * up[2]};
    }
    bool operator==(const StageTiling&) const = default;
};

struct StageLook {
    StageTiling tiling = {};
    StageTrails trails = StageTrails::fading;
    bool hasPotential = false;
    bool operator==(const StageLook&) const = default;
};

}  // namespace extremal
