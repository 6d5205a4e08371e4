// SPDX-License-Identifier: GPL-3.0-or-later
/// The work of forces and of moving constraints against time.
#include "engine/model/mechanisms.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry work() {
    return {.item = viewItem("work", "Work",
                             "work of forces, and of constraints that move with time, since the start"),
            .recipe = ColumnAgainstTime{"work"},
            .scales = againstTime,
            .observable = "balance",
            .takes = mechanisms()};
}

}  // namespace extremal::views
