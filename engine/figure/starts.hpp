// SPDX-License-Identifier: GPL-3.0-or-later
/// The motions from the starts of a view (run/cases/start_sets.hpp), coloured by their Lyapunov exponents.
#pragma once

#include "engine/figure/build.hpp"

namespace extremal {

/// One series per start, and the scale of their colours; says in the subtitle how many there are, and how
/// many have no motion. Nothing where the view has none.
void addStarts(Figure& figure, const FigureContext& context);

}  // namespace extremal
