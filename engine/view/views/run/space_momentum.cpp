// SPDX-License-Identifier: GPL-3.0-or-later
/// The components of the angular momentum in space axes, a plot each.
#include "engine/view/catalog.hpp"
#include "engine/view/momentum_columns.hpp"

namespace extremal::views {

ViewEntry space_momentum() {
    return {.item = viewItem(
                "space-momentum", "Space momentum",
                "components of the angular momentum in space axes against time, a plot each; rigid bodies"),
            .recipe = StateAgainstTime{},
            .scales = againstTime,
            .takes = Takes::everything(),
            .missing =
                [](const View&, const System& system) {
                    return std::string(momentumColumns(system, "space").empty() ? "a rigid body" : "");
                },
            .columns = [](const System& system) { return momentumColumns(system, "space"); }};
}

}  // namespace extremal::views
