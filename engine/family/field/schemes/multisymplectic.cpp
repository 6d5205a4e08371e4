// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields: polynomials of one degree on cells of space and time, with the rules that follow from it.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry multisymplectic() {
    SchemeEntry e;
    e.item = {"multisymplectic-<s>",
              "multisymplectic",
              "Fields: degree s on cells of space and time; s = 1 is leapfrog, higher degrees take Gauss.",
              {},
              {},
              "a field"};
    e.source = "Leok 2004, sec. 2.1";
    e.minDegree = 1;
    e.maxDegree = 3;
    e.make = [](int degree) {
        Discretization d;
        d.space = {"tent", {{"degree", static_cast<double>(degree)}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
