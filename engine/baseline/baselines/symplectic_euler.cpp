// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic Euler, kick first: p_1 = p_0 + h pdot(q_0, p_1), q_1 = q_0 + h qdot(q_0, p_1).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry symplectic_euler() {
    return partitionedBaseline({"symplectic-euler",
                                "symplectic Euler",
                                "Kick, then drift: order 1, explicit for separable systems.",
                                {},
                                Claims{1, false, true, {"momentum"}},
                                ""},
                               {{HalfMap::kickImplicit, 1}, {HalfMap::driftExplicit, 1}});
}

}  // namespace extremal::baselines
