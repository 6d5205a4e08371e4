// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest multiplier of equidistribution of a moving mesh, on a logarithmic axis: an indicator of the
/// error of the discrete action. Of discretizations in coordinates the size of the multiplier of continuity.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry multiplier() {
    return {
        .item = viewItem("multiplier", "Multiplier",
                         "size of the multiplier of continuity, or of that of a moving mesh, against time "
                         "or steps, logarithmic",
                         {againstField()}),
        .recipe = ErrorAgainstTime{"multiplier", "|λ|", 0},
        .scales = logAgainstTime,
        .observable = "multiplier"};
}

}  // namespace extremal::views
