// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose equations can be solved in more than one way, or by a method with a name.
#pragma once

#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

/// What the key `method` of a solver may be besides "auto". A family without it solves its equations in its
/// own way, and takes "auto" alone.
struct SolverMethods {
    static constexpr PartInfo part{"solver-methods", "methods to solve its equations", false};
    std::vector<std::string> ids;
};

}  // namespace extremal
