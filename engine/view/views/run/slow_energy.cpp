// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy without that of the fast oscillation.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry slow_energy() {
    return {.item = viewItem("slow-energy", "Slow energy",
                             "energy without that of the fast oscillation against time"),
            .recipe = ColumnAgainstTime{"slow_energy"},
            .scales = againstTime,
            .observable = "slow-energy"};
}

}  // namespace extremal::views
