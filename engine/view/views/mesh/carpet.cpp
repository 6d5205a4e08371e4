// SPDX-License-Identifier: GPL-3.0-or-later
/// A field over time and space as a heat map; wave functions with their phase as the colour, those over a
/// rectangle as their density along x. Over that of a moving mesh the paths of its nodes.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry carpet() {
    return {
        .item = viewItem("carpet", "Carpet",
                         "a field over time and space, with the paths of nodes that move; of wave functions "
                         "modulus and phase"),
        .recipe = OwnRecipe{"carpet"},
        .scales = againstTime,
        .products = {Product::frames},
        .takes = Takes::everything(),
        .missing =
            [](const View&, const System& system) {
                return std::string(system.field ? "" : "a field or a wave function");
            },
        .keys = {.hasScheme = true}};
}

}  // namespace extremal::views
