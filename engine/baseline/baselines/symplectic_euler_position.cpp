// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic Euler, drift first: q_1 = q_0 + h qdot(q_1, p_0), p_1 = p_0 + h pdot(q_1, p_0).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry symplectic_euler_position() {
    return partitionedBaseline({"symplectic-euler-position",
                                "symplectic Euler (drift first)",
                                "Drift, then kick: the adjoint of symplectic Euler, order 1.",
                                {},
                                Claims{1, false, true, {"momentum"}},
                                ""},
                               {{HalfMap::driftImplicit, 1}, {HalfMap::kickExplicit, 1}});
}

}  // namespace extremal::baselines
