// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields between two ends: 31 nodes that move with the solution.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry moving_mesh() {
    SchemeEntry e;
    e.item = {
        "moving-mesh",
        "moving mesh",
        "Fields between two ends: 31 nodes that move with the solution, equidistributed by multipliers.",
        {},
        {},
        "a field between two ends"};
    e.source = "Leok 2004, sec. 6";
    e.make = [](int) {
        Discretization d;
        d.space = {"moving-mesh",
                   {{"nodes", 31.0},
                    {"monitor", "arclength"},
                    {"alpha", "auto"},
                    {"method", "multiplier"},
                    {"beta", 1.0},
                    {"relaxation", 0.1},
                    {"speed_limit", 1.0},
                    {"fallback", true},
                    {"times", "fixed"},
                    {"mesh_mass", 0.0}},
                   {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
