// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler arcs between kicks, order 2s, by the tables that cost least for their order.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry kepler_arcs() {
    SchemeEntry e;
    e.item = {
        "kepler-arcs-<s>",
        "Kepler arcs",
        "Kepler motions about a heavy body between kicks of all other forces: explicit, order 2s (strang, "
        "aba-10-6-4, srkn-14a).",
        {},
        {},
        "bodies that a heavy one holds"};
    e.source = "Wisdom and Holman 1991; Blanes et al. 2013";
    e.minDegree = 1;
    e.maxDegree = 3;
    e.make = [](int s) {
        constexpr const char* knots[] = {"strang", "aba-10-6-4", "srkn-14a"};
        Discretization d;
        d.space = {"kepler-arcs", {{"knots", knots[s - 1]}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
