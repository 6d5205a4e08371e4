// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale scheme without its fast part: the oscillation is left out.
#include "engine/family/multiscale/slow.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_rod() {
    SchemeEntry e;
    e.item = {"multiscale-rod",
              "multiscale rod",
              "The spring a rod: the slow swing alone, order 8 in its own variables, wrong by a part 1/k.",
              {},
              {},
              "a slow model"};
    e.source = "Leok 2004, sec. 7.2, with the fast motion eliminated";
    e.make = [](int) { return slowScheme("rod", 4); };
    return e;
}

}  // namespace extremal::schemes
