// SPDX-License-Identifier: GPL-3.0-or-later
/// |L_d - L_d^exact| against the step, for every discretization: the order of the discrete action, of which
/// all others follow.
#include "engine/view/catalog.hpp"
#include "engine/view/with_equations.hpp"

namespace extremal::views {

ViewEntry discrete_lagrangian() {
    return {.item = viewItem(
                "discrete-lagrangian", "Discrete Lagrangian",
                "distance of the discrete Lagrangian of each discretization from the exact one against "
                "the step, with the fitted slope"),
            .recipe = OwnRecipe{"discrete_lagrangian"},
            .scales = logScales,
            .products = {Product::actionDefect},
            .missing = actionMissing,
            .unsuitable = [](const Discretization& d) { return equationsOf(d).actionLackingOf(d); }};
}

}  // namespace extremal::views
