// SPDX-License-Identifier: GPL-3.0-or-later
/// The components of the angular momentum in body axes, a plot each.
#include "engine/view/catalog.hpp"
#include "engine/view/momentum_columns.hpp"

namespace extremal::views {

ViewEntry body_momentum() {
    return {.item = viewItem(
                "body-momentum", "Body momentum",
                "components of the angular momentum in body axes against time, a plot each; rigid bodies"),
            .recipe = StateAgainstTime{},
            .scales = againstTime,
            .takes = Takes::everything(),
            .missing =
                [](const View&, const System& system) {
                    return std::string(momentumColumns(system, "body").empty() ? "a rigid body" : "");
                },
            .columns = [](const System& system) { return momentumColumns(system, "body"); }};
}

}  // namespace extremal::views
