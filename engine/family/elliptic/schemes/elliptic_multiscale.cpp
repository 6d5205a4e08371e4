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
        Discretization pair;
        pair.space = {"elliptic-elements", {{"functions", "multiscale"}}, {}};
        pair.quadrature = {"auto", {}, {}};
        return pair;
    };
    return e;
}

}  // namespace extremal::schemes
