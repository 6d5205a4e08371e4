// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lie group integrator of degree s with Gauss(s) in the chart at the middle of the step.
#include "engine/family/lie/lie.hpp"
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry lie_centred() {
    SchemeEntry e;
    e.item = {"lie-centred-<s>",
              "centred Lie group Gauss",
              "Degree s in the algebra with Gauss(s), in the chart at the middle of the step: order 2s, and "
              "back and forth returns to the start, by one solve a step.",
              {},
              {},
              "a rigid body, a Lie group or points on spheres"};
    e.source = "Leok 2004, sec. 3.2, with the base point inside the step";
    e.minDegree = 1;
    e.maxDegree = 8;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = lieSpace(degree, false, middleOfStep);
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
