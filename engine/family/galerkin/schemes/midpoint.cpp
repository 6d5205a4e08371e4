// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree 1 with the midpoint rule: L_d = h L((q_0 + q_1)/2, (q_1 - q_0)/h).
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry midpoint() {
    SchemeEntry e;
    e.item = {"midpoint", "midpoint", "Linear pieces with the midpoint rule: order 2, stable for every step.",
              {},         {},         ""};
    e.source = "Marsden and West 2001, 1.3.2";
    e.minDegree = 0;
    e.maxDegree = 0;
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"polynomial", {{"degree", 1.0}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"midpoint", {{"panels", 1.0}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
