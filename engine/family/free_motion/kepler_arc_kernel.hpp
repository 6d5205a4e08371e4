// SPDX-License-Identifier: GPL-3.0-or-later
/// Arcs of ellipses of eight bodies together, in the lanes of vector instructions.
#pragma once

#include <array>

namespace extremal {

/// Places, velocities and mu of eight bodies, component after component.
struct EightBodies {
    std::array<double*, 3> x, v;
    const double* mu;
};

/// Moves all of them along their ellipses over a time. False, and nothing is changed, where one of them has
/// no ellipse, or one that takes more than a few iterations: `KeplerArc` takes every conic.
bool moveOnEllipses(const EightBodies& bodies, double time);

}  // namespace extremal
