/// Störmer-Verlet, kick-drift-kick (velocity form); for any Hamiltonian the symmetric composition of the two Euler maps.
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry stormer_verlet() {
    static const std::vector<PartitionedStage> stages = {{HalfMap::kickImplicit, 0.5},
                                                        {HalfMap::driftExplicit, 0.5},
                                                        {HalfMap::driftImplicit, 0.5},
                                                        {HalfMap::kickExplicit, 0.5}};
    BaselineEntry e;
    e.item = {"stormer-verlet", "Störmer-Verlet", "Kick, drift, kick: order 2, explicit for separable systems.", {},
              Claims{2, true, true, {"momentum"}}, ""};
    e.stabilityLimit = 2;
    e.make = [](const System& system, const BaselineOptions& options) {
        return makePartitioned(system.mechanics, options.clock, stages);
    };
    return e;
}

}  // namespace extremal::baselines
