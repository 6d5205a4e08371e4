// SPDX-License-Identifier: GPL-3.0-or-later
/// The density of the local error of the action, h^(r+1) density on a step of a scheme of order r, and the
/// monitor h |density|^(1/(r+1)) that stationarity in the times makes equal on all steps. Where the density
/// changes its sign the energy equation has no root.
#include <limits>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry solvability() {
    ObservableEntry e;
    e.item = {"solvability",
              "solvability",
              "Density of the local action error, whose change of sign leaves the energy equation without a "
              "root, and the monitor that is equal on all steps; of schemes whose times are unknowns.",
              {},
              {},
              "coordinates, or a field"};
    e.takes = Takes::only<Mechanical, ScalarField>();
    e.bind = [](const ObserveContext& context) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const std::optional<std::size_t> density = context.quantity("density"),
                                         monitor = context.quantity("monitor");
        Observer o;
        o.readsQuantities = density || monitor;
        o.columns = {{"density", "ℓ", "", {}, {}}, {"monitor", "h |ℓ|^(1/(r+1))", "", {}, {}}};
        o.evaluate = [density, monitor](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = density ? nodes.quantities(i)[*density] : unknown;
                values[1] = monitor ? nodes.quantities(i)[*monitor] : unknown;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
