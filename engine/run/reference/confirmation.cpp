// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/confirmation.hpp"

namespace extremal {

double Confirmation::judgedTo(double error) const {
    double t = parts.front().t;
    for (const Part& part : parts) {
        if (safety * part.distance > error) break;
        t = part.t;
    }
    return t;
}

}  // namespace extremal
