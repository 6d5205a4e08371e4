// SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method for one periodic orbit, and a guess to begin with.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/orbits/periodic_orbit.hpp"

namespace extremal {

/// A gap below which what is left is round-off.
inline constexpr double closedGap = 1e-10;

/// An orbit; or why there is none, and what to do about it.
struct OrbitSearch {
    std::optional<PeriodicOrbit> orbit;
    std::vector<double> closes;  ///< gaps of the iterates, the guess first
    std::string problem, remedy;
    Outcome outcome = Outcome::converged;
};

/// From a guess that the equations were measured with.
OrbitSearch findOrbit(OrbitEquations& equations, const OrbitGuess& guess, const std::stop_token& stop = {});

/// Where Newton's method begins without a given period: with the time after which the motion of a scene
/// first comes back to its start, as nearly as it comes back at all. Where orbits attract, the start is that
/// of the second half of the scene. Throws InvalidScene ("--period") where the motion does not come back.
OrbitGuess nearestReturn(const ResolvedScene& scene, std::size_t scheme, OrbitKind kind);

}  // namespace extremal
