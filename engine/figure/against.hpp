// SPDX-License-Identifier: GPL-3.0-or-later
/// What views of errors have along x: time, or the number of steps done, so that what accumulates step by
/// step is seen.
///
/// Against steps both axes are logarithmic, and a thin line shows what round-off would give by chance: a
/// random walk of one rounding per step, ε √n times the scale of the quantity, a line of slope 1/2. A bias
/// gives slope 1. Rows inside a step, from dense output, have fractions of a step.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/figure/build.hpp"
#include "engine/view/axes.hpp"

namespace extremal {

/// "against time", "against the number of steps".
std::string againstText(const View& view);

/// The x axis that the view asks for, and one series per scheme: the size of a column.
void addErrors(Figure& figure, const FigureContext& context, std::string_view column);

/// "7e-13 (Gauss 4) to 6e-4 (Strang)": the least and the most of values of schemes by label; empty if there
/// are none.
std::string leastToMost(const std::vector<std::pair<double, std::string>>& values);

/// Against steps and with a round-off floor: the line of round-off by chance, along what the series cover.
/// After addErrors.
void addChance(Figure& figure, const FigureContext& context);

}  // namespace extremal
