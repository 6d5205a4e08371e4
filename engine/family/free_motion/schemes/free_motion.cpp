// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motions between kicks, order 2s, by the tables that cost least for their order.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry free_motion() {
    SchemeEntry e;
    e.item = {"free-motion-<s>",
              "free motion",
              "Free motions between kicks of the potential: explicit, order 2s (strang, srkn-6b, srkn-11b).",
              {},
              {},
              "a kinetic energy whose motion is known, and a potential"};
    e.source = "Leok 2004, sec. 2, 3 and 8";
    e.minDegree = 1;
    e.maxDegree = 3;
    e.make = [](int s) {
        Discretization d;
        d.space = {"free-motion", {{"knots", s == 1 ? "strang" : s == 2 ? "srkn-6b" : "srkn-11b"}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
