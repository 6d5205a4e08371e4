// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/splitting_baseline.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "engine/baseline/parts.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/step/wave_splitting.hpp"

namespace extremal {

BaselineEntry partitionedBaseline(CatalogItem item, std::vector<PartitionedStage> stages) {
    BaselineEntry e;
    e.item = std::move(item);
    e.parts.set(OscillatorLimit(2));
    // Of sums A(p) + B(q), and exact: fractions are 1 and 1/2.
    e.parts.set(BaselineTableau{[stages](const Settings&) {
        std::vector<SplittingStage> flows;
        for (const PartitionedStage& s : stages) flows.push_back({s.isKick(), s.fraction});
        return tableauOf(flows, 1e-30);
    }});
    e.takes = flowProblems();
    e.make = [stages = std::move(stages)](const System& system, const BaselineOptions& options) {
        return makePartitioned(flowOf(system), options.step, stages);
    };
    return e;
}

std::unique_ptr<Integrator> makeWaveSplittingBaseline(const System& system, double step,
                                                      const Splitting& splitting) {
    requireSplit(system, "/baseline", "split-step",
                 "schrodinger-gauss-8, crank-nicolson or chebyshev-propagation");
    return makeWaveSplitting(system, step, splitting);
}

BaselineEntry splittingBaseline(std::string id, std::string title, std::string description,
                                const Splitting& splitting) {
    BaselineEntry e;
    e.item = {std::move(id),
              std::move(title),
              std::move(description),
              {},
              Claims{splitting.order, true, true, {"momentum", "norm"}},
              splitting.isNystrom ? "a separable Lagrangian" : ""};
    e.takes = flowProblems().with<Wave, Interaction, Rotation>();
    e.parts.set(SystemCondition{[isNystrom = splitting.isNystrom](const System& system) {
        return system.parts.find<Wave>() || !isNystrom || flowOf(system).isSeparable;
    }});
    // Found when it is asked for: the catalogue is made at every start.
    e.parts.set(OscillatorLimit([splitting](const Settings&) { return stabilityLimit(splitting); }));
    e.parts.set(BaselineTableau{[splitting](const Settings&) { return tableauOf(splitting.stages, 1e-15); }});
    e.make = [splitting](const System& system, const BaselineOptions& options) {
        if (system.parts.find<Wave>()) return makeWaveSplittingBaseline(system, options.step, splitting);
        const Mechanics<double> flow = flowOf(system);
        return makePartitioned(flow, options.step, partitionedStages(splitting, flow.isSum()));
    };
    return e;
}

BaselineEntry waveSplittingBaseline(std::string id, std::string title, std::string description,
                                    const Splitting& splitting) {
    BaselineEntry e;
    e.item = {std::move(id),
              std::move(title),
              std::move(description),
              {},
              Claims{splitting.order, true, true, {"norm"}},
              "a wave function"};
    e.takes = Takes::only<Wave, Interaction, Rotation>();
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [splitting](const System& system, const BaselineOptions& options) {
        return makeWaveSplittingBaseline(system, options.step, splitting);
    };
    return e;
}

}  // namespace extremal
