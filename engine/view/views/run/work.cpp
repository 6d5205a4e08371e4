// SPDX-License-Identifier: GPL-3.0-or-later
/// The work of forces and of moving constraints against time.
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry work() {
    return {.item = viewItem("work", "Work",
                             "work of forces, and of constraints that move with time, since the start"),
            .recipe = ColumnAgainstTime{"work"},
            .scales = againstTime,
            .observable = "balance",
            .takes = Takes::only<Mechanical, Constraint, Force>()};
}

}  // namespace extremal::views
