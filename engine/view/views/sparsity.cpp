// SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of the equations of a discretization, nothing condensed: a square for every entry that is not
/// zero.
#include "engine/view/catalog.hpp"
#include "engine/view/with_table.hpp"

namespace extremal::views {

ViewEntry sparsity() {
    return {.item = viewItem(
                "sparsity", "KKT matrix",
                "entries that are not zero in the full equations of a discretization over some elements",
                {textField("scheme", "scheme", "",
                           "label of a discretization; left out: one picture for each, up to four")}),
            .recipe = OwnRecipe{"sparsity"},
            .scales = noScales,
            .products = {Product::kktPattern},
            .missing = coordinatesMissing,
            .unsuitable = tableMissing,
            .keys = {.hasScheme = true},
            .pictures = Pictures::perDiscretization};
}

}  // namespace extremal::views
