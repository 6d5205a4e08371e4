// SPDX-License-Identifier: GPL-3.0-or-later
/// Störmer-Verlet, kick-drift-kick (velocity form); for any Hamiltonian the symmetric composition of the two
/// Euler maps.
#include "engine/baseline/partitioned.hpp"

namespace extremal::baselines {

BaselineEntry stormer_verlet() {
    return partitionedBaseline({"stormer-verlet",
                                "Störmer-Verlet",
                                "Kick, drift, kick: order 2, explicit for separable systems.",
                                {},
                                Claims{2, true, true, {"momentum"}},
                                ""},
                               {{HalfMap::kickImplicit, 0.5},
                                {HalfMap::driftExplicit, 0.5},
                                {HalfMap::driftImplicit, 0.5},
                                {HalfMap::kickExplicit, 0.5}});
}

}  // namespace extremal::baselines
