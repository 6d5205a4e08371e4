// SPDX-License-Identifier: GPL-3.0-or-later
/// One column of the results against time, or against another column: what the views of trajectories and of
/// momentum components share.
#pragma once

#include <string>

#include "engine/figure/build.hpp"

namespace extremal {

/// The title of a state column, its first letter a capital; the symbol of others; "Trajectory" where none is
/// known.
std::string titleOfColumn(const FigureContext& context, const std::string& column);

/// One curve per scheme, y against x ("t": on the common axis of times), finished. Momenta against time are
/// drawn at the nodes: inside a step that of the curve is of lower order, and would hide how well it is kept.
Figure columnFigure(const FigureContext& context, const std::string& x, const std::string& y);

}  // namespace extremal
