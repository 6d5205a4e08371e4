// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale scheme R3: an oscillatory space and an automatic rule.
#include "engine/family/multiscale/multiscale.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_r3() {
    SchemeEntry e;
    e.item = {"multiscale-r3",
              "multiscale R3",
              "Slow degree 8, fast 5, three harmonics with amplitudes of degree 4, 2 and 1.",
              {},
              {},
              "a fast frequency of its own"};
    e.source = "Leok 2004, sec. 7.2, with additive fast parts";
    e.make = [](int) { return multiscalePair(8, 5, {4, 2, 1}); };
    return e;
}

}  // namespace extremal::schemes
