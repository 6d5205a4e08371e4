// SPDX-License-Identifier: GPL-3.0-or-later
/// How close the discrete Lagrangian of a discretization comes to the exact one: |L_d - L_d^exact| against
/// the step.
///
/// For each h of a geometric sequence, q_1 is where the exact motion from the start is after h; L_d^exact is
/// the action of the resolved boundary-value solve between q_0 and q_1, L_d the stationary action of one
/// element of the discretization. A discretization of order r has a defect O(h^(r+1)). Points below the
/// round-off of the action itself end the sequence.
#pragma once

#include <string>
#include <vector>

namespace extremal {

struct ActionDefect {
    std::vector<double> h, defect;
    double floor = 0;            ///< round-off of the smallest action
    double order = 0;            ///< slope of the fit; 0: too few points, or not on a line
    int fitFrom = 0, fitTo = 0;  ///< points of the fit, [from, to)
    std::string failure;         ///< why there is nothing to show; empty if there is
};

}  // namespace extremal
