// SPDX-License-Identifier: GPL-3.0-or-later
/// Periodic fields: Fourier modes in space, Gauss of degree s in time.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry field_gauss() {
    SchemeEntry e;
    e.item = {"field-gauss-<s>",
              "field, Fourier and Gauss",
              "Periodic fields: Fourier modes in space, Gauss of degree s in time; order 2s.",
              {},
              {},
              "a periodic field"};
    e.source = "Leok 2004, sec. 8";
    e.minDegree = 1;
    e.maxDegree = 12;
    e.make = [](int degree) {
        Discretization d;
        d.space = {"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", "same"}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
