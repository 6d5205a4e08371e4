// SPDX-License-Identifier: GPL-3.0-or-later
/// The step size against time. A scheme with a fixed step needs no column for it.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry step() {
    return {.item = viewItem("step", "Step size", "the time step of every scheme against time, logarithmic"),
            .recipe = OwnRecipe{"step"},
            .scales = logAgainstTime,
            .takes = Takes::everything(),
            .missing = [](const View&, const System& system) {
                return std::string(system.hasSteps ? "" : "a motion, or knots");
            }};
}

}  // namespace extremal::views
