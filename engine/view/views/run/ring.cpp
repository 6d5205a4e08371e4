// SPDX-License-Identifier: GPL-3.0-or-later
/// A ring of starts that moves with each scheme, in the plane of the first coordinate and its momentum. A
/// symplectic step keeps its area; in several freedoms the sum of those of its shadows, of which this is one.
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry ring() {
    return {.item = viewItem("ring", "Moving ring",
                             "a ring of 64 starts around the start, moved by each scheme with a fixed step, "
                             "at the time of the player, with the ring at the start faint; the subtitle says "
                             "by how much ∮ θ over it has changed at the end. Costs 64 runs"),
            .recipe = OwnRecipe{"ring"},
            .products = {Product::rings},
            .takes = Takes::only<Mechanical, PhaseMechanics, OneForm>(),
            .keys = {}};
}

}  // namespace extremal::views
