// SPDX-License-Identifier: GPL-3.0-or-later
/// The meshes of time of all schemes, one above the other: a tick at every node.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry mesh() {
    return {.item = viewItem("mesh", "Time mesh",
                             "the nodes of time of every scheme, a tick each; steps without a root of the "
                             "energy equation are marked"),
            .recipe = OwnRecipe{"mesh"},
            .scales = {true, false, false, Across::time},
            .products = {Product::steps},
            .takes = Takes::everything(),
            .missing = [](const View&, const System& system) {
                return std::string(system.isMotion() ? "" : "a motion");
            }};
}

}  // namespace extremal::views
