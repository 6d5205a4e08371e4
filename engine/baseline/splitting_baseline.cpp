// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/baseline/partitioned.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/baseline/wave_splitting.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal {

std::vector<PartitionedStage> partitionedStages(const Splitting& splitting, bool isSeparable) {
    std::vector<PartitionedStage> stages;
    if (isSeparable) {
        for (const SplittingStage& s : splitting.stages)
            stages.push_back({s.isKick ? HalfMap::kickExplicit : HalfMap::driftExplicit, s.fraction});
        return stages;
    }
    double c = 0;
    bool isEuler = true;
    for (std::size_t i = 0; i + 1 < splitting.stages.size(); ++i, isEuler = !isEuler) {
        c = splitting.stages[i].fraction - c;
        stages.push_back({isEuler ? HalfMap::kickImplicit : HalfMap::driftImplicit, c});
        stages.push_back({isEuler ? HalfMap::driftExplicit : HalfMap::kickExplicit, c});
    }
    return stages;
}

namespace {

/// Found when it is asked for: the catalogue is made at every start, and all limits together take longer than
/// most scenes.
class LazyLimit {
public:
    explicit LazyLimit(std::vector<SplittingStage> stages) : stages_(std::move(stages)) {}
    double value() {
        // Fractions are printed to 15 digits.
        std::call_once(isKnown_,
                       [this] { value_ = firstEdge(OscillatorStep(tableauOf(stages_, 1e-15)).intervals()); });
        return value_;
    }

private:
    std::vector<SplittingStage> stages_;
    std::once_flag isKnown_;
    double value_ = 0;
};

}  // namespace

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
    e.parts.set(OscillatorLimit(
        [limit = std::make_shared<LazyLimit>(splitting.stages)](const Settings&) { return limit->value(); }));
    e.parts.set(BaselineTableau{[splitting](const Settings&) { return tableauOf(splitting.stages, 1e-15); }});
    e.make = [splitting](const System& system, const BaselineOptions& options) {
        if (system.parts.find<Wave>()) return makeWaveSplitting(system, options.step, splitting);
        const Mechanics<double> flow = flowOf(system);
        return makePartitioned(flow, options.step, partitionedStages(splitting, flow.isSeparable));
    };
    return e;
}

}  // namespace extremal
