// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/group_flow.hpp"

#include <cstddef>
#include <functional>
#include <memory>

#include "engine/core/own_buffers.hpp"
#include "engine/model/first_order/joined_state.hpp"

namespace extremal {
namespace {

struct GroupFlow {
    std::function<bool(double t, const double* x, double* dx)> rate;
    EnergyFunction energy;
    std::size_t size;
    long long id;
};
const GroupFlow& flowAt(const void* p) { return *static_cast<const GroupFlow*>(p); }

JoinedState& joinedState(const void* p) { return ownBuffers<JoinedState>(flowAt(p).id, flowAt(p).size); }

bool groupFlow(const void* model, const double& t, const double* q, const double* p, double* qdot,
               double* pdot) {
    JoinedState& own = joinedState(model);
    if (!flowAt(model).rate(t, own.join(q, p), own.dx.data())) return false;
    own.splitRate(qdot, pdot);
    return true;
}
double groupEnergy(const void* model, const double& t, const double* q, const double* p) {
    return flowAt(model).energy(t, joinedState(model).join(q, p));
}

}  // namespace

int evenStateSize(const GroupMechanics& mechanics) {
    return mechanics.stateSize() + mechanics.stateSize() % 2;
}

bool isOnGroup(const System& system) { return system.parts.find<LieGroup>() || system.parts.find<Spheres>(); }

Mechanics<double> groupFlowOf(const System& system) {
    const LieGroup* const group = system.parts.find<LieGroup>();
    const auto size = static_cast<std::size_t>(group ? evenStateSize(*group->mechanics)
                                                     : 2 * system.part<Spheres>().mechanics->dimension());
    Mechanics<double> made;
    made.dimension = static_cast<int>(size / 2);
    made.model =
        std::make_shared<const GroupFlow>(GroupFlow{system.rate, system.energy, size, nextModelId()});
    made.energy = groupEnergy;
    made.flow = groupFlow;
    return made;
}

bool isGroupFlow(const Mechanics<double>& mechanics) { return mechanics.flow == groupFlow; }

}  // namespace extremal
