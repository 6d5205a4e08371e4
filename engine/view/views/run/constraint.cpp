// SPDX-License-Identifier: GPL-3.0-or-later
/// The distance from the constraints, on a logarithmic axis.
#include "engine/model/mechanisms.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry constraint() {
    return {
        .item = viewItem("constraint", "Distance from the constraints",
                         "largest |g| of every scheme against time or steps, logarithmic", {againstField()}),
        .recipe = ErrorAgainstTime{"constraint", "max |g|, |a v − b|"},
        .scales = logAgainstTime,
        .observable = "constraint",
        .takes = mechanisms()};
}

}  // namespace extremal::views
