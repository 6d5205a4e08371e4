// SPDX-License-Identifier: GPL-3.0-or-later
/// Degree s with Gauss(s + 1): one node more than collocation needs.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry galerkin_fine() {
    SchemeEntry e;
    // What it claims follows from space and rule, at each degree.
    e.item = {
        "galerkin-fine-<s>", "Galerkin, fine rule", "Degree s with Gauss(s + 1): order 2s.", {}, {}, ""};
    e.source = "Leok 2004, sec. 2.1";
    e.minDegree = 1;
    e.maxDegree = 12;
    e.make = [](int s) {
        Discretization discretization;
        discretization.space = {"polynomial", {{"degree", s}, {"basis", "lobatto"}}, {}};
        discretization.quadrature = {"gauss", {{"nodes", s + 1}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
