// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/space/catalog.hpp"

#include <algorithm>

#include "engine/core/problem.hpp"

namespace extremal {

Space<double> makeSpace(const Settings& space) {
    const auto& all = tableSpaces();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const SpaceEntry& e) { return e.item.id == space.type; });
    if (found == all.end()) throw InvalidScene("/space/type", "there is no space \"" + space.type + "\"");
    return found->make(space);
}

}  // namespace extremal
