// SPDX-License-Identifier: GPL-3.0-or-later
/// Linear stability of a scheme, measured on the scheme itself: what one step makes of the test equation.
///
///     with coordinates   q'' = -w^2 q,       z = h w        (the model harmonic-oscillator)
///     wave functions     i c_k' = E_k c_k,   z = h |E_k|    (two plane waves, E = -3/4 and 3/4, so that a
///                                                           shift by the mean energy changes nothing)
///
/// The step is linear here: its matrix follows from what it makes of two states (coordinates), or, of each
/// plane wave, from the recursion c_{n+2} = a c_{n+1} + b c_n that its amplitudes satisfy where the scheme
/// has levels, c_{n+1} = a c_n where it has not. With its eigenvalues r,
///
///     amplification   max |r|: 1 of a stable symplectic scheme, below 1 of one that damps
///     phase error     (arg r - z)/z of the physical eigenvalue, arg continued beyond pi
///
/// Of schemes with an error control it is the step of the formula, whatever the error. A step is stable where
/// max |r| <= 1 + 10^-6. The limit is the first z from which it is not. Of tables and symplectic Runge-Kutta
/// methods with coordinates it is the first edge of their intervals of instability, which follow from the
/// coefficients (engine/integrator/oscillator_step.hpp). Of all others it is looked for in steps of 0.01 up
/// to z = 20 and by 5 % up to 10^4, then bisected to round-off; narrow intervals of instability between may
/// be missed.
#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/study/stability/linear_region.hpp"

namespace extremal {

struct LinearStability {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    struct Point {
        double z = 0, amplification = unknown, phaseError = unknown;  ///< unknown: the step has no solution
        bool isStable() const { return amplification <= 1 + 1e-6; }
    };
    std::vector<Point> points;             ///< up to z = 4 pi
    bool hasLimit = false;                 ///< else it is stable as far as was looked
    double low = unknown, high = unknown;  ///< stable at low, not at high; low 0: not even for small z
    std::string reason;                    ///< why there is nothing, where the scheme has no linear step
    LinearRegion region;                   ///< over complex z

    double limit() const { return hasLimit ? (low + high) / 2 : std::numeric_limits<double>::infinity(); }
};

/// Of one scheme of a scene (index). Only its way of making steps counts, not its step and not the model.
LinearStability linearStability(const Scene& scene, std::size_t scheme, const std::stop_token& stop);

}  // namespace extremal
