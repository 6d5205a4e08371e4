// SPDX-License-Identifier: GPL-3.0-or-later
/// The density of the local error of the discrete action, whose sign decides whether the energy equation has
/// a root, and where along a motion it changes that sign.
///
/// For a discretization of order r, L_d = L_d^exact + h^(r+1) density + ..., and therefore
///     H(z) - E_d(z, h) = (r + 1) h^r density(z) + O(h^(r+1)).
/// Averaged over both ends of a step, or over a step on and one back, the odd powers of h cancel for a
/// symmetric rule, so that the error of the density is O(h^2). For the midpoint rule and L = |v|^2/2 - V it
/// is
/// (|q''|^2 + v . V'' v) / 24. Sources: Leok 2004, sec. 5; Marsden and West 2001, 2.3.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/state.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

/// From H, averaged as above, and the discrete energy of steps of length h.
inline double actionErrorDensity(double energy, double discreteEnergy, double h, int order) {
    return (energy - discreteEnergy) / ((order + 1) * std::pow(std::abs(h), order));
}

/// Of a table at a state, from a step of length h on and one back; `noise`: what round-off alone may give.
struct DensitySample {
    double t = 0, density = 0, noise = 0;
    bool isSignificant() const { return std::abs(density) > noise; }
};

/// What a motion tells beforehand.
struct SolvabilityForecast {
    std::vector<double> signChanges;  ///< times
    bool vanishes = false;            ///< nowhere above round-off: steps are undetermined
    double unresolved = 0;            ///< share of the motion where it is not above round-off
    double first = 0, largest = 0;    ///< its size at the start, and where it is largest
    double timeOfLargest = 0;
    double until = 0;  ///< time up to which the motion was followed
};

/// How far a motion is followed.
enum class FollowUntil {
    end,
    doubt  ///< the first place where the density changes its sign or is not above round-off
};

/// Follows the motion from a state until `end`, by at most 2000 steps of a fixed length h of a Galerkin
/// scheme of higher degree, fewer of large systems: some tens of milliseconds. Empty where a step has no
/// solution.
std::optional<SolvabilityForecast> forecastSolvability(const Mechanics<double>& mechanics,
                                                       const Table<double>& table, int order,
                                                       const State& start, double h, double end,
                                                       FollowUntil until = FollowUntil::end);

}  // namespace extremal
