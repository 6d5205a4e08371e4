/// The discrete energy E_d = -dS/dh of the step that ended at each row, and how far it is from that of the
/// first step: schemes with moving times keep it, those with a fixed step do not. The energy at the nodes is
/// another thing.
#include <limits>

#include "engine/observe/catalog.hpp"

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
    e.applies = [](const System& system) { return isMechanical(system) || isField(system); };
    e.bind = [](const ObserveContext& context) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const std::optional<std::size_t> energy = context.quantity("discrete_energy");
        Observer o;
        o.readsQuantities = energy.has_value();
        o.columns = {{"discrete_energy", "E_d", context.system.energyUnit, {}, {}},
                     {"discrete_energy_error", "E_d - E_d(0)", context.system.energyUnit, {}, {}}};
        o.extreme = 1;
        o.evaluate = [energy, first = unknown](const NodeBlock& nodes, double* values,
                                               std::size_t stride) mutable {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = energy ? nodes.quantities(i)[*energy] : unknown;
                if (!(first == first)) first = values[0];
                values[1] = values[0] - first;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
