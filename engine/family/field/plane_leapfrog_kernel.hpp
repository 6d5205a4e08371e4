// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of leapfrog over a periodic rectangle of one component, in one pass through memory:
///
///     v+ = v + h/2 a(u),  u' = u + h v+,  v' = v+ + h/2 a(u'),
///     a = perX (left - 2 u + right) + perY (below - 2 u + above) - W'(u).
/// A row is moved on, then the row below it, whose neighbours are there now, is kicked again: 2 n numbers are
/// read and 2 n are written. Internal to engine/family/field.
#pragma once

#include <cstddef>

#include "engine/model/field/potential.hpp"

namespace extremal {

struct PlaneLeapfrogKernel {
    std::size_t nx = 0, ny = 0;  ///< nodes along each axis, nx >= 2, ny >= 3
    double h = 0;
    double perX = 0, perY = 0;  ///< c^2/dx^2, c^2/dy^2
    CubicSlope slope;           ///< W'

    /// next must not overlap. False where a velocity is not finite.
    bool step(const double* u, const double* v, double* nextU, double* nextV) const;
};

}  // namespace extremal
