// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of leapfrog on a uniform mesh for a force that is a cubic of u, in one pass through memory:
///
///     v+ = v + h/2 a(u),  u' = u + h v+,  v' = v+ + h/2 a(u'),
///     a_i = k (u_{i-1} - 2 u_i + u_{i+1}) - u_i (alpha + beta u_i^2).
/// Blocks of nodes that fit into the first cache are moved on, and kicked again one node behind. 2 n numbers
/// are read and 2 n are written. Internal to engine/family/field.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.hpp"
#include "engine/model/field/potential.hpp"

namespace extremal {

struct LeapfrogKernel {
    double h = 0, k = 0;
    CubicSlope slope;  ///< W'; alpha and beta above
    Boundary boundary = Boundary::periodic;

    /// n >= 3 nodes; next must not overlap. False where a value is not finite.
    bool step(const double* u, const double* v, double* nextU, double* nextV, std::size_t n) const;
};

}  // namespace extremal
