// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree s with Clenshaw-Curtis(s + 1): order 2 and 4 for s = 1 and 2, then 4 for odd and 6 for even s.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry spectral_clenshaw_curtis() {
    SchemeEntry e;
    e.item = {"spectral-clenshaw-curtis-<s>",
              "spectral Clenshaw-Curtis",
              "Degree s with Clenshaw-Curtis on s + 1 nodes, as in spectral variational integrators: order 4 "
              "for odd, 6 for even degrees from 3 on.",
              {},
              {},
              ""};
    e.source = "Hall and Leok 2015";
    e.minDegree = 1;
    e.maxDegree = 24;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = {
            "polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"clenshaw-curtis", {{"nodes", static_cast<double>(degree + 1)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
