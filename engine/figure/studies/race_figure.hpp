// SPDX-License-Identifier: GPL-3.0-or-later
/// The plot of a search: every candidate as the path of its runs, errors against costs, from the coarsest to
/// what it ended with.
#pragma once

#include "engine/figure/figure.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// Those that reach the wish in the colours of their schemes, those that do not faint, the nearest of them
/// with the reason at their last run; the wish as a line. Costs are CPU seconds, or evaluations where runs
/// are not timed.
Figure raceFigure(const Sweep& sweep);

}  // namespace extremal
