// SPDX-License-Identifier: GPL-3.0-or-later
/// Change of volumes of phase space in each step, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry volume() {
    return {.item = viewItem("volume", "Phase-space volume",
                             "|det M − 1| against time or steps, logarithmic; M is the tangent map of a step",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"volume", "|det M − 1|", 1},
            .scales = logAgainstTime,
            .observable = "volume"};
}

}  // namespace extremal::views
