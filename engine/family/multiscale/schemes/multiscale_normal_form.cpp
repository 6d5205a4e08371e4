// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale schemes for the normal form of the fast part.
#include <string>

#include "engine/family/multiscale/slow.hpp"

namespace extremal::schemes {

SchemeEntry multiscale_normal_form() {
    SchemeEntry e;
    e.item = {"multiscale-normal-form-<s>",
              "multiscale normal form",
              "Averaged canonically with s corrections in 1/k: the whole motion, the phase of the "
              "oscillation in closed form.",
              {},
              {},
              "a slow model"};
    e.source = "Leok 2004, sec. 7.2, with the fast motion eliminated";
    e.minDegree = 1;
    e.maxDegree = 3;
    e.make = [](int corrections) {
        return slowScheme(("normal-form-" + std::to_string(corrections)).c_str(), 4);
    };
    return e;
}

}  // namespace extremal::schemes
