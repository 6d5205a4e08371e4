// SPDX-License-Identifier: GPL-3.0-or-later
/// The polhode: the momentum in the body on its sphere, with the curves of constant energy on which a free
/// body moves.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry polhode() {
    return {
        .item = viewItem("polhode", "Polhode",
                         "the momentum in the body on its sphere, with curves of equal energy; rigid bodies"),
        .recipe = OwnRecipe{"polhode"},
        .scales = noScales,
        .takes = Takes::only<Body>()};
}

}  // namespace extremal::views
