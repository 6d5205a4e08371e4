// SPDX-License-Identifier: GPL-3.0-or-later
/// Finite elements of the elliptic problem: multiscale elements.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry elliptic_multiscale() {
    SchemeEntry e;
    e.item = {
        "elliptic-multiscale",
        "multiscale elements",
        "Functions that solve the problem without a source: exact at the nodes, however coarse the mesh.",
        {},
        {},
        "the elliptic problem"};
    e.source = "Leok 2004, sec. 7.1";
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {"elliptic-elements", {{"functions", "multiscale"}}, {}};
        discretization.quadrature = {"auto", {}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
