// SPDX-License-Identifier: GPL-3.0-or-later
/// Energy of the fast oscillation around its slow mean.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry fast_energy() {
    ObservableEntry e;
    e.item = {"fast-energy",
              "fast energy",
              "Energy of the fast oscillation around its slow mean.",
              {},
              {},
              "a fast oscillation of its own"};
    e.suits = [](const System& system) { return static_cast<bool>(system.fast.energy); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"fast_energy", "H_fast", context.system.energyUnit, {}, {}}};
        const EnergyFunction fast = context.system.fast.energy;
        o.evaluate = [fast](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                *values = fast(nodes.t(i), nodes.x(i));
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
