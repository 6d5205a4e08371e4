// SPDX-License-Identifier: GPL-3.0-or-later
/// The momenta that Noether's theorem conserves, those of the system or of the symmetries that are found, and
/// the Euclidean norm of their change. A momentum that is a column of the state already is not written twice.
/// Those whose symmetry moves time are not in the norm where there are others: steps of a fixed length do not
/// keep them.
#include <algorithm>
#include <cmath>

#include "engine/model/density/part.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/measured.hpp"
#include "engine/symmetry/conserved.hpp"

namespace extremal::observables {
ObservableEntry momentum() {
    ObservableEntry e;
    e.item = {"momentum",
              "momentum",
              "Conserved momenta and the norm of their change; for systems with a symmetry, which is found.",
              {},
              {},
              "a symmetry"};
    e.takes = plainProblemsAndMechanisms().with<LieGroup, Spheres, Spins, DensityField>();
    e.suits = [](const System& system) { return measureOf(system, "momentum") || hasMomenta(system); };
    e.bind = [](const ObserveContext& context) {
        if (const Measure* mean = measureOf(context.system, "momentum"))
            return bindMeasure(*mean, context.initial);
        Observer o;
        const std::vector<ConservedMomentum> momenta = momentaOf(context.system);
        const bool isTimeCounted =
            std::all_of(momenta.begin(), momenta.end(), [](const auto& each) { return each.movesTime; });
        const auto state = stateColumns(context.system);
        std::vector<double> start;
        std::vector<bool> isWritten;
        for (const ConservedMomentum& map : momenta) {
            const std::string name = "momentum." + map.name;
            start.push_back(map.value(context.initial.t, context.initial.x.data()));
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
        o.evaluate = [momenta, start, isWritten, isTimeCounted, change = std::vector<double>(momenta.size()),
                      zero = std::vector<double>(momenta.size())](const NodeBlock& nodes, double* values,
                                                                  std::size_t stride) mutable {
            for (std::size_t node = 0; node < nodes.size(); ++node, values += stride) {
                double sum = 0;
                std::size_t column = 0;
                for (std::size_t i = 0; i < momenta.size(); ++i) {
                    const double now = momenta[i].value(nodes.t(node), nodes.x(node));
                    if (isWritten[i]) values[column++] = now;
                    const bool isCounted = isTimeCounted || !momenta[i].movesTime;
                    change[i] = isCounted ? now - start[i] : 0;
                    sum += change[i] * change[i];
                }
                // Squares leave the range of numbers long before the changes do.
                values[column] = isSafeSquare(sum)
                                     ? std::sqrt(sum)
                                     : scaledDistance(change.size(), change.data(), zero.data());
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
