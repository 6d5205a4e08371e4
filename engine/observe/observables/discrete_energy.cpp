// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete energy E_d = -dS/dh of the step that ended at each row, and how far it is from that of the
/// first step: schemes with moving times keep it, those with a fixed step do not. The energy at the nodes is
/// another thing.
#include "engine/observe/catalog.hpp"
#include "engine/model/density/part.hpp"

namespace extremal::observables {

ObservableEntry discrete_energy() {
    ObservableEntry e;
    e.item = {"discrete-energy",
              "discrete energy",
              "Discrete energy of the step that ended at each row, and its distance from that of the first "
              "step; of discretizations without a fast frequency, and of fields.",
              {},
              {},
              "coordinates, or a field"};
    e.takes = Takes::only<Mechanical, ScalarField, DensityField>();
    e.bind = [](const ObserveContext& context) {
        const std::string& unit = context.system.energyUnit;
        return observeQuantity(context, "discrete_energy", {"discrete_energy", "E_d", unit, {}, {}},
                               {"discrete_energy_error", "E_d - E_d(0)", unit, {}, {}});
    };
    return e;
}

}  // namespace extremal::observables
