// SPDX-License-Identifier: GPL-3.0-or-later
/// What a wanted error will take of a scheme, from one run: whether a search for its step is worth while.
///
/// A run of W evaluations with the error E has, at the claimed order p,
///     W (E / E_wanted)^(1/p)
/// to come, and at least W/8: an error that is small already does not let steps grow without end. Only
/// evaluations are compared, which are the same on every machine, so that every shard comes to the same
/// result; evaluations of one system cost the same within a factor of about ten.
///
/// Unknown for schemes without an order, under error control, or without evaluations to count (these are
/// always searched), and for runs that failed.
#pragma once

#include <span>

#include "engine/study/search/point.hpp"

namespace extremal {

struct Prospect {
    double work = PointResult::unknown;  ///< evaluations for the wanted error
    double perStep = 0;
};

Prospect prospectOf(const ResolvedScheme& scheme, const PointResult& first, double wantedError);

/// Of all schemes: the least work, or infinity.
double leastWork(std::span<const Prospect> prospects);

/// A scheme that needs more than this many times the least work is given up: even evaluations that cost a
/// tenth would not make it the cheapest if the least were underestimated ten times as well.
constexpr double mostTimesTheLeast = 100;

}  // namespace extremal
