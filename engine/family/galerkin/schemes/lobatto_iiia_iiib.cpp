// SPDX-License-Identifier: GPL-3.0-or-later
/// The partitioned pair Lobatto IIIA-IIIB with s stages, as a Galerkin integrator: degree s - 1 with
/// Lobatto(s).
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry lobatto_iiia_iiib() {
    SchemeEntry e;
    e.item = {
        "lobatto-iiia-iiib-<s>",
        "Lobatto IIIA-IIIB",
        "The partitioned Runge-Kutta pair with s stages as a Galerkin integrator, order 2s - 2; s = 2 is "
        "Störmer-Verlet.",
        {},
        {},
        ""};
    e.source = "Hairer, Lubich, Wanner 2006, II.2.2 and VI.6.4; Marsden and West 2001, 2.6.5";
    e.minDegree = 2;
    e.maxDegree = 25;
    e.make = [](int stages) {
        Discretization discretization;
        discretization.space = {
            "polynomial", {{"degree", static_cast<double>(stages - 1)}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"lobatto", {{"nodes", static_cast<double>(stages)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
