// SPDX-License-Identifier: GPL-3.0-or-later
/// The plot of regions of stability over the complex plane z = h lambda.
#pragma once

#include "engine/figure/figure.hpp"
#include "engine/study/stability/linear_study.hpp"

namespace extremal {

/// The boundaries |r| = 1 of all schemes; of a single scheme over |r| as colours. Where r jumps (a branch
/// cut) there is no boundary.
Figure regionFigure(const LinearStudy& linear);

}  // namespace extremal
