// SPDX-License-Identifier: GPL-3.0-or-later
/// Half a step of the adjoint Lie group integrator of degree s with Gauss(s), then half a step of it.
#include "engine/family/lie/lie.hpp"
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry lie_symmetric() {
    SchemeEntry e;
    e.item = {"lie-symmetric-<s>",
              "symmetric Lie group Gauss",
              "Half a step of the adjoint of lie-<s>, then half a step of it: order 2s, and back and forth "
              "returns to the start.",
              {},
              {},
              "a rigid body, a Lie group or points on spheres"};
    e.source = "Leok 2004, sec. 3.2; Hairer, Lubich and Wanner 2006, II.3";
    e.minDegree = 1;
    e.maxDegree = 8;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = lieSpace(degree, true);
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
