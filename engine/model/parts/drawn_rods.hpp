// SPDX-License-Identifier: GPL-3.0-or-later
/// Which segments of the drawing of a system are rods, and the constraints that keep their lengths; a part
/// that does not bind the motion.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct DrawnRods {
    static constexpr PartInfo part{"drawn-rods", "rods of a drawing", false};

    /// The constraint is |r1 - r2|^2 - l^2: with the multiplier lambda the rod pushes with 2 l lambda.
    struct Rod {
        std::size_t shape = 0;  ///< its place among the shapes of a drawing
        std::string constraint;
    };
    std::vector<Rod> all;
};

}  // namespace extremal
