// SPDX-License-Identifier: GPL-3.0-or-later
/// A free body in quaternions, of degree s with Gauss(s).
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry quaternion() {
    SchemeEntry e;
    e.item = {"quaternion-<s>",
              "quaternion Gauss",
              "Degree s in the quaternion of a free body with Gauss(s), as one spin: order 2s, with products "
              "alone and so the cheapest.",
              {},
              {},
              "a free rigid body"};
    e.source = "Leok 2004, sec. 3";
    e.minDegree = 1;
    e.maxDegree = 8;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = {"quaternion-polynomial", {{"degree", static_cast<double>(degree)}}, {}};
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
