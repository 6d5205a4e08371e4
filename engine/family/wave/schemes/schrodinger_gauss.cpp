// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions: Fourier in space, degree s with Gauss(s) in time.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry schrodinger_gauss() {
    SchemeEntry e;
    e.item = {
        "schrodinger-gauss-<s>",
        "Schrödinger Gauss",
        "Fourier in space, degree s with Gauss(s) in time: order 2s, keeps norm and energy to round-off.",
        {},
        {},
        "a wave function"};
    e.source = "Leok 2004, sec. 8.2";
    e.minDegree = 1;
    e.maxDegree = 16;
    e.make = [](int degree) {
        Discretization discretization;
        discretization.space = {"fourier",
                                {{"degree", static_cast<double>(degree)},
                                 {"energy_shift", "mean"},
                                 {"form", "one-step"},
                                 {"start", "gauss"}},
                                {}};
        discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
