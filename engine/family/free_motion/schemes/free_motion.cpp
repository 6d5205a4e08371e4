// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motions between kicks, order 2s, by the tables that cost least for their order.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry free_motion() {
    SchemeEntry e;
    e.item = {"free-motion-<s>",
              "free motion",
              "Free motions between kicks of the potential: explicit, order 2s (strang, srkn-6b, srkn-11b, "
              "srkn-19a).",
              {},
              {},
              "a kinetic energy whose motion is known, and a potential"};
    e.source = "Leok 2004, sec. 2, 3 and 8";
    e.minDegree = 1;
    e.maxDegree = 4;
    e.make = [](int s) {
        constexpr const char* knots[] = {"strang", "srkn-6b", "srkn-11b", "srkn-19a"};
        Discretization d;
        d.space = {"free-motion", {{"knots", knots[s - 1]}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
