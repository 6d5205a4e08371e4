// SPDX-License-Identifier: GPL-3.0-or-later
/// Splittings of Blanes and Moan (2002), whose coefficients are in splitting_table: S6 and S10 for any
/// separable system, the Nyström ones for L = 1/2 sum m v^2 - V(t, q), with those of order 8 by Blanes, Casas
/// and Escorihuela-Tomàs (2022).
#include "engine/baseline/splitting_baseline.hpp"

namespace extremal::baselines {

std::vector<BaselineEntry> splittings() {
    return {
        splittingBaseline(
            "blanes-moan-s6", "Blanes-Moan S6",
            "Optimised splitting of order 4 with six kicks: errors far below Yoshida's for the same work.",
            blanesMoanS6()),
        splittingBaseline("blanes-moan-s10", "Blanes-Moan S10",
                          "Optimised splitting of order 6 with ten kicks, explicit for separable systems.",
                          blanesMoanS10()),
        splittingBaseline("srkn-6b", "Blanes-Moan SRKN 6b",
                          "Symplectic Runge-Kutta-Nyström of order 4 with six kicks.", srkn6b()),
        splittingBaseline("srkn-11b", "Blanes-Moan SRKN 11b",
                          "Symplectic Runge-Kutta-Nyström of order 6 with eleven kicks.", srkn11b()),
        splittingBaseline("srkn-14a", "Blanes-Moan SRKN 14a",
                          "Symplectic Runge-Kutta-Nyström of order 6 with fourteen kicks, drift first.",
                          srkn14a()),
        splittingBaseline("srkn-19a", "Blanes-Casas SRKN 19a",
                          "Symplectic Runge-Kutta-Nyström of order 8 with nineteen kicks, drift first: for "
                          "errors from about 1e-8 on.",
                          srkn19a()),
        splittingBaseline("srkn-19b", "Blanes-Casas SRKN 19b",
                          "Symplectic Runge-Kutta-Nyström of order 8 with nineteen kicks.", srkn19b()),
    };
}

}  // namespace extremal::baselines
