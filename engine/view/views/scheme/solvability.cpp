// SPDX-License-Identifier: GPL-3.0-or-later
/// The density of the local action error along the run: where it changes its sign the energy equation has no
/// root.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry solvability() {
    return {.item = viewItem(
                "solvability", "Solvability density",
                "cube root of the density of the local action error of schemes whose times are "
                "unknowns, against time: without a root of the energy equation where it changes its sign"),
            .recipe = OwnRecipe{"solvability"},
            .scales = againstTime,
            .observable = "solvability"};
}

}  // namespace extremal::views
