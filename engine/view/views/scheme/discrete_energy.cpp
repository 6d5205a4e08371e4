// SPDX-License-Identifier: GPL-3.0-or-later
/// |E_d - E_d(0)| on a logarithmic axis: what schemes with moving times keep to round-off.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry discrete_energy() {
    return {.item = viewItem("discrete-energy", "Discrete energy error",
                             "|E_d − E_d(0)| of discretizations against time or steps, logarithmic: constant "
                             "where the times are unknowns; the energy at the nodes is another thing",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"discrete_energy_error", "|E_d − E_d(0)|", 1},
            .scales = logAgainstTime,
            .observable = "discrete-energy"};
}

}  // namespace extremal::views
