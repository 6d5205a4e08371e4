// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree 1 with the trapezoidal rule: for separable systems this is Störmer-Verlet.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry trapezoidal() {
    SchemeEntry e;
    e.item = {"trapezoidal",
              "trapezoidal",
              "Linear pieces with the trapezoidal rule: Störmer-Verlet as a Galerkin integrator, order 2.",
              {},
              {},
              ""};
    e.source = "Marsden and West 2001, 2.4.3";
    e.minDegree = 0;
    e.maxDegree = 0;
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"polynomial", {{"degree", 1.0}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"trapezoid", {{"panels", 1.0}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
