// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy of the fast oscillation around its slow mean.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry fast_energy() {
    return {.item = viewItem("fast-energy", "Fast energy",
                             "energy of the fast oscillation against time; for models that know a fast "
                             "oscillation of their own"),
            .recipe = ColumnAgainstTime{"fast_energy"},
            .scales = againstTime,
            .observable = "fast-energy"};
}

}  // namespace extremal::views
