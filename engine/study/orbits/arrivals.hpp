// SPDX-License-Identifier: GPL-3.0-or-later
/// Motions between two positions of a scene (/initial/q, q1, at), one for each scheme: the momentum with
/// which its own discrete motion arrives, by Newton's method on its tangent map.
///
/// There may be several motions: which is found depends on where the method begins, by default with the
/// momentum of the exact motion that the scene has. Where det dq_n/dp_0 = 0 the end is conjugate to the
/// start, and motions next to each other arrive together.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {

struct Arrival {
    std::string scheme;  ///< its label
    long long steps = 0;
    std::vector<double> start;   ///< q and p
    std::vector<double> misses;  ///< distance from the goal of each iterate, the guess first
    double determinant = 0;      ///< of dq_n / dp_0
    Outcome outcome = Outcome::converged;
};

/// Of the enabled schemes, or of the one with this label. `momentum`: where Newton's method begins; empty:
/// that of the exact motion. Throws InvalidScene where whole steps do not reach the goal, or the scene has no
/// second position.
std::vector<Arrival> seekArrivals(const ResolvedScene& scene, const std::string& only,
                                  const std::vector<double>& momentum, const std::stop_token& stop = {});

/// arrivals.csv: a row per scheme.
StudyTable arrivalsTable(const ResolvedScene& scene, const std::vector<Arrival>& arrivals);
/// The scene with a momentum in place of the second position.
Value arrivalScene(const ResolvedScene& scene, const Arrival& arrival);

}  // namespace extremal
