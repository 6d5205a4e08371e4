/// Symplectic Euler, drift first: q_1 = q_0 + h qdot(q_1, p_0), p_1 = p_0 + h pdot(q_1, p_0).
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry symplectic_euler_position() {
    static const std::vector<PartitionedStage> stages = {{HalfMap::driftImplicit, 1}, {HalfMap::kickExplicit, 1}};
    BaselineEntry e;
    e.item = {"symplectic-euler-position", "symplectic Euler (drift first)", "Drift, then kick: the adjoint of symplectic Euler, order 1.", {},
              Claims{1, false, true, {"momentum"}}, ""};
    e.stabilityLimit = 2;
    e.make = [](const System& system, const BaselineOptions& options) {
        return makePartitioned(system.mechanics, options.clock, stages);
    };
    return e;
}

}  // namespace extremal::baselines
