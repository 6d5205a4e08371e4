// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance to the reference on a logarithmic axis, with the floor below which the reference itself is no
/// better.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry error() {
    return {.item = viewItem("error", "Error",
                             "distance to the reference solution against time or steps, logarithmic",
                             {againstField()}),
            .recipe = OwnRecipe{"error"},
            .scales = logAgainstTime,
            .observable = "error"};
}

}  // namespace extremal::views
