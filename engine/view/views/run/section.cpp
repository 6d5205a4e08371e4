// SPDX-License-Identifier: GPL-3.0-or-later
/// A Poincaré section: the states where one column passes zero upwards, found on the dense output of each
/// scheme.
#include "engine/view/catalog.hpp"
#include "engine/view/plane.hpp"

namespace extremal::views {

ViewEntry section() {
    return {.item = viewItem(
                "section", "Section",
                "states where a column passes zero upwards, on the dense output of each scheme",
                {textField("at", "at", "", "state column that passes zero, by default the first coordinate"),
                 textField("x", "x", "", "state column to the right, by default the second coordinate, or t"),
                 textField("y", "y", "",
                           "state column upwards, by default the second momentum, or the first of one"),
                 textField("scheme", "scheme", "",
                           "label of the scheme that integrates the starts, by default the first"),
                 startsFields()[0], startsFields()[1]}),
            .recipe = OwnRecipe{"section"},
            .products = {Product::sections, Product::starts},
            .takes = Takes::everything(),
            .missing =
                [](const View&, const System& system) {
                    const bool isMotion = !stateColumns(system).empty() && system.isMotion();
                    return std::string(isMotion ? "" : "a motion of a few numbers");
                },
            .keys = {.hasColumns = true, .hasZeros = true, .hasScheme = true, .hasStarts = true}};
}

}  // namespace extremal::views
