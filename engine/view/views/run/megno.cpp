// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean of MEGNO up to each time, against the logarithm of time.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry megno() {
    return {
        .item = viewItem("megno", "MEGNO",
                         "mean of MEGNO up to each time, over the logarithm of time: 2 where the motion is "
                         "regular, growing where it is chaotic"),
        .recipe = OwnRecipe{"megno"},
        .scales = Scales{true, true, false},
        .observable = "lyapunov"};
}

}  // namespace extremal::views
