// SPDX-License-Identifier: GPL-3.0-or-later
/// Leok's scheme for wave functions: Fourier in space, linear in time, the action integrated exactly.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry schrodinger_three_level() {
    SchemeEntry e;
    e.item = {"schrodinger-three-level",
              "Schrödinger three-level",
              "Fourier in space, linear in time with the exact integral: order 4 with a Gauss start, stable "
              "for |E| dt < √3 ħ.",
              {},
              {},
              "a wave function"};
    e.source = "Leok 2004, sec. 8.2";
    e.minDegree = 0;
    e.maxDegree = 0;
    e.make = [](int) {
        Discretization discretization;
        discretization.space = {
            "fourier",
            {{"degree", 1.0}, {"energy_shift", "mean"}, {"form", "three-level"}, {"start", "gauss"}},
            {}};
        discretization.quadrature = {"exact", {}, {}};
        return discretization;
    };
    return e;
}

}  // namespace extremal::schemes
