// SPDX-License-Identifier: GPL-3.0-or-later
/// Lie group variational integrator of degree s with Gauss(s).
#include "engine/family/lie/lie.hpp"
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry lie() {
    SchemeEntry e;
    e.item = {"lie-<s>",
              "Lie group Gauss",
              "Degree s in the algebra with Gauss(s), for bodies and Lie groups: order 2s, keeps the spatial "
              "momentum "
              "to round-off.",
              {},
              {},
              "a rigid body, a Lie group or points on spheres"};
    e.source = "Leok 2004, sec. 3.2";
    e.minDegree = 1;
    e.maxDegree = 8;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = lieSpace(degree);
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
