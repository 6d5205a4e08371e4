// SPDX-License-Identifier: GPL-3.0-or-later
/// The energy without that of the fast oscillation.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry slow_energy() {
    ObservableEntry e;
    e.item = {"slow-energy",
              "slow energy",
              "The energy without that of the fast oscillation.",
              {},
              {},
              "a fast oscillation of its own"};
    e.suits = [](const System& system) { return static_cast<bool>(system.fast.energy); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"slow_energy", "H - H_fast", context.system.energyUnit, {}, {}}};
        const EnergyFunction fast = context.system.fast.energy;
        o.evaluate = [fast, energy = energyOf(context.system)](const NodeBlock& nodes, double* values,
                                                               std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                *values = energy(nodes.t(i), nodes.x(i)) - fast(nodes.t(i), nodes.x(i));
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
