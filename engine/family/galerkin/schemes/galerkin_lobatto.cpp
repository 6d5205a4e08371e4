// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree s with Lobatto(s + 1) equals the partitioned pair Lobatto IIIA-IIIB.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry galerkin_lobatto() {
    SchemeEntry e;
    e.item = {"galerkin-lobatto-<s>",
              "Galerkin Lobatto",
              "Degree s with Lobatto(s + 1): the pair Lobatto IIIA-IIIB, order 2s.",
              {},
              {},
              ""};
    e.source = "Leok 2004, sec. 2.1; Marsden and West 2001, 2.6.6";
    e.minDegree = 1;
    e.maxDegree = 24;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = {
            "polynomial", {{"degree", static_cast<double>(degree)}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"lobatto", {{"nodes", static_cast<double>(degree + 1)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
