// SPDX-License-Identifier: GPL-3.0-or-later
/// Local error of each scheme, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry local_error() {
    return {
        .item = viewItem("local-error", "Local error",
                         "the error made in each step, logarithmic, against time or steps", {againstField()}),
        .recipe = ErrorAgainstTime{"local_error", "|d|"},
        .scales = logAgainstTime,
        .observable = "local-error"};
}

}  // namespace extremal::views
