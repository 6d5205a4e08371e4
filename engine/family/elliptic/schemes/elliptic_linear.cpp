// SPDX-License-Identifier: GPL-3.0-or-later
/// Finite elements of the elliptic problem: linear elements.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry elliptic_linear() {
    SchemeEntry e;
    e.item = {"elliptic-linear",
              "linear elements",
              "Hat functions: they see the mean of the coefficient until the mesh resolves it.",
              {},
              {},
              "the elliptic problem"};
    e.source = "Leok 2004, sec. 7.1";
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"elliptic-elements", {{"functions", "linear"}}, {}};
        discretization.quadrature = {"auto", {}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
