// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lyapunov exponent up to each time, against the logarithm of time.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry lyapunov() {
    return {.item = viewItem("lyapunov", "Lyapunov exponent",
                             "largest Lyapunov exponent up to each time, both axes logarithmic: it comes to "
                             "rest where the motion is chaotic"),
            .recipe = OwnRecipe{"lyapunov"},
            .scales = logScales,
            .observable = "lyapunov"};
}

}  // namespace extremal::views
