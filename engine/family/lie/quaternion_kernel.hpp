// SPDX-License-Identifier: GPL-3.0-or-later
/// The stages of a free body's step in quaternions (quaternion_step.hpp), all of them together in vector
/// registers:
///     Q_i = q_0 + h sum_j a_ij F_j,     F_i = Q_i (0, I^-1 vec(Q_i^* pi Q_i)) / 2,
/// by fixed-point iteration, four components each. A sweep costs 20 to 40 ns and contracts by some h |omega|
/// times the spectral radius of a, which is 0.15 at 4 and 0.08 at 8 stages.
#pragma once

namespace extremal {

struct QuaternionStages {
    static constexpr int most = 8;  ///< stages; lanes beyond the last one repeat it

    int stages = 0, maxSweeps = 0;
    double tolerance = 0;                    ///< of the change that a further sweep would make, relative to F
    double halfRate[3] = {};                 ///< 1 / (2 I)
    double start[4] = {}, momentum[3] = {};  ///< q_0, and pi in space
    alignas(64) double a[most][most] = {};   ///< column j: h a_ij
    alignas(64) double F[4][most] = {};  ///< component by component; the starting values, then the solution

    int sweeps = 0;     ///< made
    double change = 0;  ///< relative, of the last one
    bool isSolved = false;
};

/// The iteration in the instruction set of this machine.
using QuaternionSweeps = void (*)(QuaternionStages&);
QuaternionSweeps quaternionSweeps(int stages);

}  // namespace extremal
