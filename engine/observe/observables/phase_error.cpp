// SPDX-License-Identifier: GPL-3.0-or-later
/// The phase by which a state is ahead of the reference (System::phaseError).
#include <vector>

#include "engine/model/wave/interaction.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry phase_error() {
    ObservableEntry e;
    e.item = {"phase-error",
              "phase error",
              "Phase of the wave function against the reference.",
              {},
              {},
              "a wave function and a reference"};
    e.takes = Takes::only<Wave, Interaction, Rotation>();
    e.needsReference = true;
    e.suits = [](const System& system) { return static_cast<bool>(system.phaseError.evaluate); };
    e.bind = [](const ObserveContext& context) {
        const ErrorMeasure& measure = context.system.phaseError;
        Observer o;
        o.extreme = 0;
        for (const Quantity& c : measure.columns) o.columns.push_back({c.name, c.symbol, c.unit, {}, {}});
        o.evaluate = [width = context.initial.x.size(), evaluate = measure.evaluate,
                      reference = context.reference, exact = std::vector<double>()](
                         const NodeBlock& nodes, double* values, std::size_t stride) mutable {
            exact.resize(width * nodes.size());
            reference(nodes.times(), exact.data(), width);
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                evaluate(nodes.x(i), exact.data() + i * width, values);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
