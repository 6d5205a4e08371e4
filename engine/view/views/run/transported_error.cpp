// SPDX-License-Identifier: GPL-3.0-or-later
/// Transported error of each scheme, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry transported_error() {
    return {.item = viewItem("transported-error", "Transported error",
                             "what the local errors have become, carried along by the tangent maps of the "
                             "steps, logarithmic, against time or steps",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"transported_error", "|e|"},
            .scales = logAgainstTime,
            .observable = "local-error"};
}

}  // namespace extremal::views
