// SPDX-License-Identifier: GPL-3.0-or-later
/// The speed after a contact for which the discrete energies of the parts of a step before and after it are
/// equal (ImpactLaw::variational).
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "engine/core/impact.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

/// Finds the root by Newton's method with the derivative of H, dH/dspeed = m speed with the mass
/// m = J / (speed+ - speed-) that the impact shows, and then by the secant. `impact`: just made with H- = H+.
/// `strike(speed)`: makes it again with this speed after it, false where that cannot be. `energyAhead()`: the
/// discrete energy of the part after it, nothing where there is none and `outcome` says why.
/// `energyUnsolvable` where the speed would not lead away from the wall, or is not found.
template <class Strike, class Energy>
Outcome matchEnergiesAtContact(const Impact& impact, double energyBefore, const Strike& strike,
                               const Energy& energyAhead, const Outcome& outcome) {
    constexpr int most = 50;
    constexpr double tiny = 4 * std::numeric_limits<double>::epsilon();
    const double first = impact.speedAfter;
    double speed = first, slope = impact.impulse / (first - impact.speedBefore) * first;
    double lastError = 0, lastSpeed = first;
    for (int iteration = 0; iteration < most; ++iteration) {
        const std::optional<double> ahead = energyAhead();
        if (!ahead) return outcome;
        const double error = *ahead - energyBefore;
        if (speed != lastSpeed && error != lastError) slope = (error - lastError) / (speed - lastSpeed);
        const double change = error / slope;
        if (std::abs(change) <= tiny * std::abs(speed)) return Outcome::converged;
        // Errors that no longer fall are the rounding of energies.
        const bool isRounding = iteration > 2 && std::abs(error) >= std::abs(lastError);
        if (isRounding && std::abs(change) < 1e-10 * std::abs(speed)) return Outcome::converged;
        lastError = error;
        lastSpeed = speed;
        speed -= change;
        if (!(speed * first > 0) || !strike(speed)) break;
    }
    return Outcome::energyUnsolvable;
}

}  // namespace extremal
