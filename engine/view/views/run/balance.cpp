// SPDX-License-Identifier: GPL-3.0-or-later
/// The balance of energy and work, on a logarithmic axis.
#include "engine/model/mechanisms.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry balance() {
    return {.item = viewItem("balance", "Balance of energy and work",
                             "|H − H(0) − W| of every scheme against time or steps, logarithmic: what energy "
                             "is where forces and moving constraints do the work W",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"balance", "|H − H(0) − W|"},
            .scales = logAgainstTime,
            .observable = "balance",
            .takes = mechanisms()};
}

}  // namespace extremal::views
