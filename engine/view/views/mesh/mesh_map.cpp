// SPDX-License-Identifier: GPL-3.0-or-later
/// The map from the computational domain to space of each scheme at the end, and at the start: X over the
/// share of the nodes before it.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry mesh_map() {
    FieldInfo show = choiceField("show", "show", {"map", "density", "field"},
                                 "X over the computational coordinate; the density of the nodes over X; or "
                                 "the field over the computational coordinate.");
    return {.item = viewItem("mesh-map", "Mesh map",
                             "the map from the computational domain to space at the end, the density of "
                             "nodes, or the field over the computational domain",
                             {std::move(show)}),
            .recipe = OwnRecipe{"mesh_map"},
            .scales = againstPlace,
            .products = {Product::frames},
            .takes = Takes::only<ScalarField>()};
}

}  // namespace extremal::views
