// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree s with Gauss(s) equals s-stage Gauss collocation.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry galerkin_gauss() {
    SchemeEntry e;
    e.item = {"galerkin-gauss-<s>",
              "Galerkin Gauss",
              "Degree s with Gauss(s): Gauss collocation, order 2s, stable for every step.",
              {},
              {},
              ""};
    e.source = "Leok 2004, sec. 2.1";
    e.minDegree = 1;
    e.maxDegree = 24;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = {
            "polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
