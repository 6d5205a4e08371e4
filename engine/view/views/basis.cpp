// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of one step, with the nodes and weights of the rule.
#include "engine/quadrature/tensor.hpp"
#include "engine/space/typed.hpp"
#include "engine/view/catalog.hpp"
#include "engine/view/with_table.hpp"

namespace extremal::views {

ViewEntry basis() {
    return {.item = viewItem(
                "basis", "Functions of a step",
                "the functions that a discretization makes of its space, over one step, with the nodes "
                "and weights of its rule; and what the rule makes of the kinetic energy",
                {textField("scheme", "scheme", "",
                           "label of a discretization; left out: one picture for each, up to four")}),
            .recipe = OwnRecipe{"basis"},
            .scales = noScales,
            .missing = coordinatesMissing,
            .unsuitable =
                [](const Discretization& d) {
                    const bool isFitted = !isTermRule(d.quadrature) && dependsOnStep(d.space);
                    return isFitted ? std::string() : tableMissing(d);
                },
            .keys = {.hasScheme = true},
            .pictures = Pictures::perDiscretization};
}

}  // namespace extremal::views
