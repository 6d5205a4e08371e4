/// The momenta that Noether's theorem conserves, and the Euclidean norm of their change.
#include <cmath>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry momentum() {
    ObservableEntry e;
    e.item = {"momentum", "momentum", "Conserved momenta and the norm of their change; for systems with a symmetry.", {},
              {}, "a symmetry"};
    e.applies = [](const System& system) { return !system.momenta.empty(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const auto& momenta = context.system.momenta;
        const auto d = static_cast<std::size_t>(context.system.dimension());
        std::vector<double> start;
        for (const MomentumMap& map : momenta) {
            o.columns.push_back({"momentum." + map.name, map.symbol, map.unit, {}});
            start.push_back(map.value(context.initial.x.data(), context.initial.x.data() + d));
        }
        o.columns.push_back({"momentum_error", momenta.size() == 1 ? momenta[0].symbol + " - " + momenta[0].symbol + "(0)"
                                                                   : "change of momentum",
                             momenta.empty() ? "" : momenta[0].unit, {}});
        o.extreme = static_cast<int>(momenta.size());
        o.evaluate = [momenta, start, d](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t node = 0; node < nodes.size(); ++node, values += stride) {
                double sum = 0;
                for (std::size_t i = 0; i < momenta.size(); ++i) {
                    values[i] = momenta[i].value(nodes.x(node), nodes.x(node) + d);
                    const double change = values[i] - start[i];
                    sum += change * change;
                }
                values[momenta.size()] = std::sqrt(sum);
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
