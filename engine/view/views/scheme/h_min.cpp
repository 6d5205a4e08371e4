// SPDX-License-Identifier: GPL-3.0-or-later
/// The smallest element of a field's mesh against time.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry h_min() {
    return {.item = viewItem("h-min", "Smallest element",
                             "length of the smallest element of the mesh of a field against time"),
            .recipe = ColumnAgainstTime{"h_min"},
            .scales = againstTime,
            .observable = "h-min"};
}

}  // namespace extremal::views
