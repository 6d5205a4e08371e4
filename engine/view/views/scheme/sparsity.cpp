// SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of the equations of a discretization: a square for every entry that is not zero. Of schemes in
/// coordinates, of bodies and of fields it is the KKT matrix, nothing condensed; of wave functions and of
/// boundary-value problems the linear system.
#include "engine/view/catalog.hpp"
#include "engine/view/with_equations.hpp"

namespace extremal::views {

ViewEntry sparsity() {
    return {.item = viewItem(
                "sparsity", "Matrix of the equations",
                "entries that are not zero in the full equations of a discretization over some elements in "
                "time, of a field over some cells of one slab",
                {textField("scheme", "scheme", "",
                           "label of a discretization; left out: one picture for each, up to four")}),
            .recipe = OwnRecipe{"sparsity"},
            .scales = noScales,
            .products = {Product::kktPattern},
            .missing = matrixMissing,
            .unsuitable = [](const Discretization& d) { return equationsOf(d).matrix.lackingOf(d); },
            .keys = {.hasScheme = true},
            .pictures = Pictures::perDiscretization};
}

}  // namespace extremal::views
