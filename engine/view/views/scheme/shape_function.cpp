// SPDX-License-Identifier: GPL-3.0-or-later
/// The shape function of a node: what the finite elements of each scheme are made of.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry shape_function() {
    return {
        .item = viewItem("shape-function", "Shape function",
                         "the function of a node that each scheme of the elliptic problem is made of",
                         {integerField("node", "i", 1, 1e5, nullptr,
                                       "node inside, from left to right; by default the one in the middle")}),
        .recipe = OwnRecipe{"shape_function"},
        .scales = againstPlace,
        .takes = Takes::only<EllipticPart>(),
        .keys = {.hasNode = true}};
}

}  // namespace extremal::views
