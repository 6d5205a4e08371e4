// SPDX-License-Identifier: GPL-3.0-or-later
/// The s-stage Gauss collocation method as a Galerkin integrator: degree s with Gauss(s).
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry gauss_collocation() {
    SchemeEntry e;
    e.item = {
        "gauss-collocation-<s>",
        "Gauss collocation",
        "The s-stage Gauss collocation method as a Galerkin integrator, order 2s, stable for every step.",
        {},
        {},
        ""};
    e.source = "Hairer, Lubich, Wanner 2006, II.1.3 and VI.6.3";
    e.minDegree = 1;
    e.maxDegree = 24;
    e.make = [](int stages) {
        Discretization discretization;
        discretization.space = {
            "polynomial", {{"degree", static_cast<double>(stages)}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(stages)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
