// SPDX-License-Identifier: GPL-3.0-or-later
/// Energy of the fast oscillation divided by its instantaneous frequency: the slow motion changes it only by
/// a small periodic part.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry adiabatic_invariant() {
    ObservableEntry e;
    e.item = {"adiabatic-invariant",
              "adiabatic invariant",
              "Energy of the fast oscillation over its frequency; nearly constant over very long times.",
              {},
              {},
              "a fast oscillation of its own"};
    e.suits = [](const System& system) { return static_cast<bool>(system.fast.invariant); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const std::string &energy = context.system.energyUnit, &time = context.system.timeUnit;
        o.columns = {{"adiabatic_invariant",
                      "H_fast / ω",
                      energy + (energy.empty() || time.empty() ? "" : " ") + time,
                      {},
                      {}}};
        o.evaluate = [invariant = context.system.fast.invariant](const NodeBlock& nodes, double* values,
                                                                 std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                *values = invariant(nodes.t(i), nodes.x(i));
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
