// SPDX-License-Identifier: GPL-3.0-or-later
/// How good the schemes are between their nodes: distance of the dense output of each from the reference.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry curve_error() {
    return {.item = viewItem(
                "curve-error", "Error between nodes",
                "distance of the dense output of each scheme from the reference against time, logarithmic"),
            .recipe = OwnRecipe{"curve_error"},
            .scales = logAgainstTime,
            .observable = "error",
            .products = {Product::denseError},
            .missing = [](const View&, const System& system) {
                return std::string(stateColumns(system).empty() ? "a state of a few numbers" : "");
            }};
}

}  // namespace extremal::views
