// SPDX-License-Identifier: GPL-3.0-or-later
/// The axes of a picture of a KKT matrix: each block of unknowns has its name in its middle, "z_2" of a node
/// and "p_2" of a multiplier, along the columns and down the rows. Rows grow downwards, as in print, so
/// numbers of an axis would count them backwards.
#pragma once

#include <string>

#include "engine/figure/figure.hpp"
#include "engine/run/kkt_pattern.hpp"

namespace extremal {

/// `nameOf`: the names that a family gives its blocks (family/step_equations.hpp); null: these.
void nameBlocks(Figure& figure, const KktPattern& pattern,
                std::string (*nameOf)(const UnknownBlock&, int elements) = nullptr);

}  // namespace extremal
