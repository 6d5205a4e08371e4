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
        Discretization pair;
        pair.space = {"elliptic-elements", {{"functions", "linear"}}, {}};
        pair.quadrature = {"auto", {}, {}};
        return pair;
    };
    return e;
}

}  // namespace extremal::schemes
