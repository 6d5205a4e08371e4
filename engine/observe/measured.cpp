// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/observe/measured.hpp"

#include <utility>

#include "engine/model/density/part.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal {

Observer bindMeasure(const Measure& measure, const State& initial) {
    Observer o;
    for (const Quantity& q : measure.columns) o.columns.push_back({q.name, q.symbol, q.unit, {}, {}});
    o.extreme = measure.extreme;
    o.evaluate = [evaluate = measure.bind(initial)](const NodeBlock& nodes, double* values,
                                                    std::size_t stride) {
        for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
            evaluate(nodes.t(i), nodes.x(i), values);
    };
    return o;
}

ObservableEntry measuredObservable(CatalogItem item) {
    ObservableEntry e;
    e.takes = plainProblems()
                  .with<Interaction, LieGroup, Spheres, PhaseMechanics, Spins, PoissonStructure, Rotation,
                        DensityField>();
    e.suits = [id = item.id](const System& system) { return measureOf(system, id) != nullptr; };
    e.bind = [id = item.id](const ObserveContext& context) {
        return bindMeasure(*measureOf(context.system, id), context.initial);
    };
    e.item = std::move(item);
    return e;
}

}  // namespace extremal
