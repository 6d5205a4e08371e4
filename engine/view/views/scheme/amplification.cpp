// SPDX-License-Identifier: GPL-3.0-or-later
/// By how much each step amplifies the error that there was before it.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry amplification() {
    return {.item = viewItem(
                "amplification", "Amplification",
                "by how much each step amplifies the error that there was before it, |M e| / |e|", {}),
            .recipe = ColumnAgainstTime{"amplification"},
            .scales = againstTime,
            .observable = "local-error"};
}

}  // namespace extremal::views
