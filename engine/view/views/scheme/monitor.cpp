// SPDX-License-Identifier: GPL-3.0-or-later
/// The monitor that stationarity in the times makes equal on all steps.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry monitor() {
    return {.item = viewItem("monitor", "Equidistribution monitor",
                             "step times the root of the density of the local action error, against time: "
                             "constant but for O(h²) between resets"),
            .recipe = ColumnAgainstTime{"monitor", true},
            .scales = againstTime,
            .observable = "solvability"};
}

}  // namespace extremal::views
