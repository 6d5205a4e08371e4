// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves of constant energy on the momentum sphere of a free rigid body.
///
/// With w_1 > w_2 > w_3 the inverse moments of inertia and e = 2 E / |Pi|^2, the curves around axis 1 on the
/// unit sphere are
///     n_2 = sqrt((w_1 - e)/(w_1 - w_2)) cos phi,  n_3 = sqrt((w_1 - e)/(w_1 - w_3)) sin phi,  n_1 = +-sqrt(1
///     - n_2^2 - n_3^2),
/// e between w_2 and w_1, and alike around axis 3; e = w_2 is the separatrix.
#pragma once

#include <array>
#include <vector>

namespace extremal {

struct EnergyCurve {
    std::vector<std::array<double, 3>>
        points;    ///< unit vectors n = Pi / |Pi| in body axes; the first is the last
    double e = 0;  ///< 2 E / |Pi|^2
    bool isSeparatrix = false;
};

/// Four levels around either end of the order of the moments, each on both sides; of equal moments those that
/// are left.
std::vector<EnergyCurve> energyCurves(const std::array<double, 3>& inertia, int pieces);

}  // namespace extremal
