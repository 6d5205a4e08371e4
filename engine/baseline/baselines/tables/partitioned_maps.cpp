// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic Euler and Störmer-Verlet as half-maps in turn:
///
///     kick first      p_1 = p_0 + h pdot(q_0, p_1),  q_1 = q_0 + h qdot(q_0, p_1)
///     drift first     q_1 = q_0 + h qdot(q_1, p_0),  p_1 = p_0 + h pdot(q_1, p_0)
/// Störmer-Verlet is the symmetric composition of the two, for any Hamiltonian.
#include "engine/baseline/splitting_baseline.hpp"

namespace extremal::baselines {

std::vector<BaselineEntry> partitioned_maps() {
    const auto row = [](const char* id, const char* title, const char* description, int order,
                        std::vector<PartitionedStage> stages) {
        return partitionedBaseline(
            {id, title, description, {}, Claims{order, order == 2, true, {"momentum"}}, ""},
            std::move(stages));
    };
    return {
        row("symplectic-euler", "symplectic Euler",
            "Kick, then drift: order 1, explicit for separable systems.", 1,
            {{HalfMap::kickImplicit, 1}, {HalfMap::driftExplicit, 1}}),
        row("symplectic-euler-position", "symplectic Euler (drift first)",
            "Drift, then kick: the adjoint of symplectic Euler, order 1.", 1,
            {{HalfMap::driftImplicit, 1}, {HalfMap::kickExplicit, 1}}),
        row("stormer-verlet", "Störmer-Verlet", "Kick, drift, kick: order 2, explicit for separable systems.",
            2,
            {{HalfMap::kickImplicit, 0.5},
             {HalfMap::driftExplicit, 0.5},
             {HalfMap::driftImplicit, 0.5},
             {HalfMap::kickExplicit, 0.5}}),
        row("stormer-verlet-position", "Störmer-Verlet (drift first)",
            "Drift, kick, drift: order 2, explicit for separable systems.", 2,
            {{HalfMap::driftImplicit, 0.5},
             {HalfMap::kickExplicit, 0.5},
             {HalfMap::kickImplicit, 0.5},
             {HalfMap::driftExplicit, 0.5}}),
    };
}

}  // namespace extremal::baselines
