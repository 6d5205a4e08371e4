// SPDX-License-Identifier: GPL-3.0-or-later
/// What the points of a sweep say of a wanted error: which scheme would reach it at the lowest cost.
///
/// Each scheme's points are taken in the order of its ladder, from the largest step (or tolerance) down.
/// Where the first point that reaches the error follows one that does not, step and cost are interpolated
/// between the two,
///
///     log h = (1 - s) log h_a + s log h_b,   s = (log E_a - log E)/(log E_a - log E_b),
///
/// and likewise log cpu; the step is then shortened to make a whole number of steps. Where the first point of
/// the ladder reaches the error already, it is proposed as it is: nothing is extrapolated.
#pragma once

#include <limits>
#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

struct Proposal {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::size_t scheme = 0;          ///< index in the scene
    double step = 0, tolerance = 0;  ///< one of them is 0
    double predictedSeconds = unknown;
    std::size_t row = 0;  ///< of the sweep: the point, measured, that reaches the error
};

/// The schemes that reach it, the cheapest first.
std::vector<Proposal> proposalsFor(const Sweep& sweep, double wantedError);

}  // namespace extremal
