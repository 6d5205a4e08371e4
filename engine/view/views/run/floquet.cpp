// SPDX-License-Identifier: GPL-3.0-or-later
/// The trace of the product of all tangent maps since the start, against time.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry floquet() {
    return {.item = viewItem("floquet", "Floquet trace",
                             "trace of the product of the tangent maps of all steps, against time: after one "
                             "period the sum of the multipliers"),
            .recipe = ColumnAgainstTime{"floquet_trace"},
            .scales = againstTime,
            .observable = "floquet"};
}

}  // namespace extremal::views
