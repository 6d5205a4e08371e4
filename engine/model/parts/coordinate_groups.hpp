// SPDX-License-Identifier: GPL-3.0-or-later
/// Which coordinates belong together, as those of one body: a linear system is solved by blocks of them. A
/// part that does not bind the motion.
#pragma once

#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct CoordinateGroups {
    static constexpr PartInfo part{"coordinate-groups", "coordinates that belong together", false};

    /// Coordinates that are in none are grouped by the constraints that hold them.
    std::vector<std::vector<int>> all;
};

}  // namespace extremal
