// SPDX-License-Identifier: GPL-3.0-or-later
/// The step h for which the discrete energy of a slab has a given value,
///
///     E_d(h) = -dS/dh = E:
/// stationarity of the action in the end time of the slab, which all of its nodes share. E_d - H is -3 h^2
/// times the density of the action's error of the midpoint rule, so that the secant method is used for u =
/// h^2, in which E_d is linear to leading order.
///
/// Source: Leok 2004, sec. 6.
#pragma once

#include <algorithm>
#include <cmath>

namespace extremal {

struct EnergyRoot {
    double h = 0;
    double slope = 0;  ///< dE_d/du there, for the next search
    bool isFound = false;
};

/// `energyOf(h)` solves the slab and gives its energy, not a number where there is no solution; the last call
/// is that of the step found. From a step `last`, with the slope of an earlier search or 0. No step is less
/// than half or more than twice the last one.
template <class EnergyOf>
EnergyRoot findEnergyRoot(EnergyOf&& energyOf, double E, double last, double slope, double tolerance) {
    constexpr int mostSteps = 12;
    constexpr double probe = 0.02, noise = 32;
    const double least = last * last / 4, most = 4 * last * last;
    double u = last * last, F = energyOf(last) - E;
    for (int i = 0; i < mostSteps && std::isfinite(F); ++i) {
        if (std::abs(F) <= tolerance) return {std::copysign(std::sqrt(u), last), slope, true};
        const double wanted = slope != 0 ? u - F / slope : (1 + probe) * u,
                     next = std::clamp(wanted, least, most);
        if (!(std::abs(next - u) > 1e-14 * u)) break;
        const double now = energyOf(std::copysign(std::sqrt(next), last)) - E;
        // a difference of two values that are round-off has no slope
        if (std::abs(now - F) > noise * tolerance) slope = (now - F) / (next - u);
        const bool isStuck = !(std::abs(now) < std::abs(F)) && std::abs(now) <= noise * tolerance;
        u = next;
        F = now;
        if (isStuck) break;
    }
    return {std::copysign(std::sqrt(u), last), slope, std::abs(F) <= noise * tolerance};
}

}  // namespace extremal
