// SPDX-License-Identifier: GPL-3.0-or-later
/// What grows with time on chaotic motions, against the logarithm of the time since the start.
#pragma once

#include <string>

#include "engine/figure/build.hpp"

namespace extremal {

/// One series per scheme: a column, or its magnitude, over the time since the start. The y axis is to be set;
/// finishFigure() is to come.
Figure growthFigure(const FigureContext& context, const std::string& column, Take take);

/// "0.043 (Gauss 4) to 0.068 (RK4)": the last values of the series; empty where there are none.
std::string lastValues(const Figure& figure);

}  // namespace extremal
