// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale scheme R1: an oscillatory space and an automatic rule.
#include "engine/family/multiscale/multiscale.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_r1() {
    SchemeEntry e;
    e.item = {"multiscale-r1",
              "multiscale R1",
              "Slow degree 4, fast 2, one harmonic with linear amplitudes: the cheapest step over fast "
              "oscillations.",
              {},
              {},
              "a fast frequency of its own"};
    e.source = "Leok 2004, sec. 7.2, with additive fast parts";
    e.make = [](int) { return multiscalePair(4, 2, {1}); };
    return e;
}

}  // namespace extremal::schemes
