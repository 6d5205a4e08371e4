// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance of the way back from the way there, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry reversibility() {
    return {
        .item = viewItem("reversibility", "There and back",
                         "distance between the state of the run and that of a run back from its end, against "
                         "time or steps, logarithmic",
                         {againstField()}),
        .recipe = ErrorAgainstTime{"reversibility", "|x back − x|", 1},
        .scales = logAgainstTime,
        .observable = "reversibility"};
}

}  // namespace extremal::views
