// SPDX-License-Identifier: GPL-3.0-or-later
/// |H(t) - H(0)| on a logarithmic axis; says how many schemes drift (engine/figure/trend.hpp).
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry energy() {
    return {.item = viewItem("energy", "Energy error",
                             "|H(t) − H(0)| of every scheme against time or steps, logarithmic",
                             {againstField()}),
            .recipe = OwnRecipe{"energy"},
            .scales = logAgainstTime,
            .observable = "energy"};
}

}  // namespace extremal::views
