/// A Poincaré section: the states where one column passes zero upwards, found on the dense output of each
/// scheme.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry section() {
    return {.item = viewItem(
                "section", "Section",
                "states where a column passes zero upwards, on the dense output of each scheme",
                {textField("at", "at", "", "state column that passes zero, by default the first coordinate"),
                 textField("x", "x", "", "state column to the right, by default the second coordinate, or t"),
                 textField("y", "y", "",
                           "state column upwards, by default the second momentum, or the first of one")}),
            .recipe = OwnRecipe{"section"},
            .products = {Product::sections},
            .missing =
                [](const View&, const System& system) {
                    const bool isMotion = !stateColumns(system).empty() && !kindOf<BoundaryProblem>(system);
                    return std::string(isMotion ? "" : "a motion of a few numbers");
                },
            .keys = {.hasColumns = true, .hasZeros = true}};
}

}  // namespace extremal::views
