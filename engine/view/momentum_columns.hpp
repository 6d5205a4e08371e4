// SPDX-License-Identifier: GPL-3.0-or-later
/// The components of the angular momentum of a rigid body: its state columns momentum.<axes>.<component>.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

/// `axes` is "body" or "space"; empty for other systems.
inline std::vector<std::string> momentumColumns(const System& system, std::string_view axes) {
    std::vector<std::string> names;
    for (const Quantity& c : stateColumns(system))
        if (c.name.starts_with("momentum." + std::string(axes) + ".")) names.push_back(c.name);
    return names;
}

}  // namespace extremal
