// SPDX-License-Identifier: GPL-3.0-or-later
/// Störmer-Verlet, drift-kick-drift (position form).
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry stormer_verlet_position() {
    return partitionedBaseline({"stormer-verlet-position",
                                "Störmer-Verlet (drift first)",
                                "Drift, kick, drift: order 2, explicit for separable systems.",
                                {},
                                Claims{2, true, true, {"momentum"}},
                                ""},
                               {{HalfMap::driftImplicit, 0.5},
                                {HalfMap::kickExplicit, 0.5},
                                {HalfMap::kickImplicit, 0.5},
                                {HalfMap::driftExplicit, 0.5}});
}

}  // namespace extremal::baselines
