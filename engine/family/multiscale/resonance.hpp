/// Steps at which an oscillatory space does not determine the curve: the linear system of a step, given (q_0,
/// p_0), is singular at isolated z = step * frequency (for the space 1, cos, sin where 2 sin(z/2) (z cos(z/2)
/// - 2 sin(z/2)) = 0), one for each integer z/pi and just below it, the later and the narrower the richer the
/// space. Nearby the step still works, with errors enlarged.
#pragma once

#include <optional>

#include "engine/family/scheme.hpp"

namespace extremal {

struct Resonance {
    double conditioning =
        0;  ///< of the step on the harmonic oscillator of the same frequency, worst fast coordinate
    double usual = 0;    ///< the same at the near step
    double periods = 0;  ///< fast periods in a step
    double near = 0;     ///< a step nearby where the fractional part of z/pi is between 0.1 and 0.5
};

/// Conditioning of the step of a discretization on the harmonic oscillator of its frequency; 0 where the
/// discretization does not oscillate.
double stepConditioning(const System& system, const Discretization& discretization, double step);

/// What stands against a step, if anything. Throws InvalidScene where the discretization cannot be made.
std::optional<Resonance> resonanceOf(const System& system, const Discretization& discretization, double step);

}  // namespace extremal
