// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale scheme for the mean of the fast part.
#include "engine/family/multiscale/slow.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_averaged() {
    SchemeEntry e;
    e.item = {"multiscale-averaged",
              "multiscale averaged",
              "Averaged over the oscillation: the slow swing alone, order 8 in its own variables.",
              {},
              {},
              "a slow model"};
    e.source = "Leok 2004, sec. 7.2, with the fast motion eliminated";
    e.make = [](int) { return slowScheme("averaged", 4); };
    return e;
}

}  // namespace extremal::schemes
