// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale scheme R2: an oscillatory space and an automatic rule.
#include "engine/family/multiscale/multiscale.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_r2() {
    SchemeEntry e;
    e.item = {"multiscale-r2",
              "multiscale R2",
              "Slow degree 6, fast 4, two harmonics with amplitudes of degree 3 and 1.",
              {},
              {},
              "a fast frequency of its own"};
    e.source = "Leok 2004, sec. 7.2, with additive fast parts";
    e.make = [](int) { return multiscalePair(6, 4, {3, 1}); };
    return e;
}

}  // namespace extremal::schemes
