// SPDX-License-Identifier: GPL-3.0-or-later
/// Why methods that are made for problems like this one do not take it, in its own words.
#pragma once

#include <string>

#include "engine/model/parts.hpp"

namespace extremal {

struct RefusedBecause {
    static constexpr PartInfo part{"refused-because", "why usual methods do not take it", false};
    std::string reason;  ///< "its Lagrangian density is not u_t^2/2 - ..: it depends on t"
};

}  // namespace extremal
