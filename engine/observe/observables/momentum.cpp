/// The momenta that Noether's theorem conserves, and the Euclidean norm of their change. A momentum that is a
/// column of the state already is not written twice.
#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/observe/catalog.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal::observables {
namespace {

/// <p>, which a potential changes.
Observer meanOfWave(const std::shared_ptr<const Hamiltonian>& h) {
    Observer o;
    o.columns = {{"momentum", h->isPlane() ? "⟨p x⟩" : "⟨p⟩", "", {}, {}}};
    if (h->isPlane()) o.columns.push_back({"momentum_y", "⟨p y⟩", "", {}, {}});
    o.evaluate = [h](const NodeBlock& nodes, double* values, std::size_t stride) {
        for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
            const MeanMomentum mean = meanMomentum(*h, coefficients(nodes.x(i)));
            values[0] = mean.x;
            if (h->isPlane()) values[1] = mean.y;
        }
    };
    return o;
}

}  // namespace

ObservableEntry momentum() {
    ObservableEntry e;
    e.item = {"momentum",
              "momentum",
              "Conserved momenta and the norm of their change; for systems with a symmetry.",
              {},
              {},
              "a symmetry"};
    e.applies = [](const System& system) { return !system.momenta.empty() || system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        if (context.system.hasWave()) return meanOfWave(context.system.wave);
        Observer o;
        const auto& momenta = context.system.momenta;
        const auto d = static_cast<std::size_t>(context.system.dimension());
        const auto state = stateColumns(context.system);
        std::vector<double> start;
        std::vector<bool> isWritten;
        for (const MomentumMap& map : momenta) {
            const std::string name = "momentum." + map.name;
            start.push_back(map.value(context.initial.x.data(), context.initial.x.data() + d));
            isWritten.push_back(
                std::none_of(state.begin(), state.end(), [&](const Quantity& q) { return q.name == name; }));
            if (isWritten.back()) o.columns.push_back({name, map.symbol, map.unit, {}, {}});
        }
        o.extreme = static_cast<int>(o.columns.size());
        o.columns.push_back({"momentum_error",
                             momenta.size() == 1 ? momenta[0].symbol + " - " + momenta[0].symbol + "(0)"
                                                 : "change of momentum",
                             momenta.empty() ? "" : momenta[0].unit,
                             {},
                             {}});
        o.evaluate = [momenta, start, isWritten, d](const NodeBlock& nodes, double* values,
                                                    std::size_t stride) {
            for (std::size_t node = 0; node < nodes.size(); ++node, values += stride) {
                double sum = 0;
                std::size_t column = 0;
                for (std::size_t i = 0; i < momenta.size(); ++i) {
                    const double now = momenta[i].value(nodes.x(node), nodes.x(node) + d);
                    if (isWritten[i]) values[column++] = now;
                    sum += (now - start[i]) * (now - start[i]);
                }
                values[column] = std::sqrt(sum);
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
