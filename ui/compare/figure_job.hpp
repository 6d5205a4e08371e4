// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures and the stage of a comparison, made away from the window's thread.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/figure/figure.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/workspace/run_control.hpp"

namespace extremal {

struct FigureJob {
    std::shared_ptr<const Comparison> results;
    std::vector<std::pair<int, View>> views;  ///< with the number of their plot
    bool makesStage = true;
};

struct FigureSet {
    FigureJob job;
    std::vector<Figure> figures;  ///< of job.views
    std::optional<StagePlayer> player;
};

FigureSet makeFigures(const FigureJob& job);

/// What stands in the place of a figure before there is one: its title, and whether it is computed or waits.
Figure figureToCome(const View& view, RunControl::State state);

/// Whether two comparisons give the same figures.
bool isSameData(const Comparison& a, const Comparison& b);

}  // namespace extremal
