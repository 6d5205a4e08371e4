// SPDX-License-Identifier: GPL-3.0-or-later
/// Measured cost against measured error, one point per scheme: lower and further left is better.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry work_precision() {
    return {.item = viewItem("work-precision", "Speed against accuracy",
                             "largest error over CPU time, one point per scheme"),
            .recipe = OwnRecipe{"work_precision"},
            .scales = logScales,
            .takes = Takes::everything()};
}

}  // namespace extremal::views
