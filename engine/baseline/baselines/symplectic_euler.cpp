/// Symplectic Euler, kick first: p_1 = p_0 + h pdot(q_0, p_1), q_1 = q_0 + h qdot(q_0, p_1).
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry symplectic_euler() {
    static const std::vector<PartitionedStage> stages = {{HalfMap::kickImplicit, 1}, {HalfMap::driftExplicit, 1}};
    BaselineEntry e;
    e.item = {"symplectic-euler", "symplectic Euler", "Kick, then drift: order 1, explicit for separable systems.", {},
              Claims{1, false, true, {"momentum"}}, ""};
    e.stabilityLimit = 2;
    e.make = [](const System& system, const BaselineOptions& options) {
        return makePartitioned(system.mechanics, options.clock, stages);
    };
    return e;
}

}  // namespace extremal::baselines
