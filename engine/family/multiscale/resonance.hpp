// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps at which an oscillatory space does not determine the curve: the linear system of a step, given (q_0,
/// p_0), is singular at isolated z = step * frequency (for the space 1, cos, sin where 2 sin(z/2) (z cos(z/2)
/// - 2 sin(z/2)) = 0), one just below each integer z/pi in long steps; in steps of few periods they lie
/// elsewhere, and coordinates that are not fast have such steps as well, on the motion of a free particle.
/// They are found where the determinant changes its sign. Nearby the step still works, with errors enlarged.
#pragma once

#include <optional>

#include "engine/family/scheme.hpp"

namespace extremal {

struct Resonance {
    double at = 0;    ///< the singular step
    double near = 0;  ///< a step nearby that has none near it; 0: none was found
};

/// Conditioning of the step of a discretization on the harmonic oscillator of its frequency; 0 where the
/// discretization does not oscillate.
double stepConditioning(const System& system, const Discretization& discretization, double step);

/// A singular step near this one, if there is one. Throws InvalidScene where the discretization cannot be
/// made.
std::optional<Resonance> resonanceOf(const System& system, const Discretization& discretization, double step);

}  // namespace extremal
