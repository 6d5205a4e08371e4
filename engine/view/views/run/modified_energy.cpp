// SPDX-License-Identifier: GPL-3.0-or-later
/// |H_h - H_h(0)| on a logarithmic axis: what symplectic schemes keep of the energy.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry modified_energy() {
    return {.item = viewItem("modified-energy", "Modified energy error",
                             "|H_h − H_h(0)| against time or steps, logarithmic: the modified energy, which "
                             "symplectic schemes keep up to tiny terms, and others do not",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"modified_energy_error", "|H_h − H_h(0)|", 1},
            .scales = logAgainstTime,
            .observable = "modified-energy"};
}

}  // namespace extremal::views
