// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree 1 with Lobatto(2): L_d = h (L(q_0, v) + L(q_1, v)) / 2, v = (q_1 - q_0) / h.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry stormer_verlet_pair() {
    SchemeEntry e;
    e.item = {"stormer-verlet-pair",
              "Störmer-Verlet, variational",
              "Linear pieces with both ends as nodes: kick, drift, kick for separable systems, order 2.",
              {},
              {},
              ""};
    e.source = "Marsden and West 2001, 2.4.3; Hairer, Lubich, Wanner 2006, I.1.4 and VI.6.2";
    e.minDegree = 0;
    e.maxDegree = 0;
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"polynomial", {{"degree", 1.0}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"lobatto", {{"nodes", 2.0}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
