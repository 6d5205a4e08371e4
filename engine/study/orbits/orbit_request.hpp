// SPDX-License-Identifier: GPL-3.0-or-later
/// A periodic orbit, or a family of them, as it is asked for by the words of the command line, and what is
/// written of it.
#pragma once

#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/catalog.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/orbits/manifold.hpp"
#include "engine/study/orbits/orbit_facts.hpp"

namespace extremal {

struct OrbitRequest {
    std::string scheme = {};  ///< its label; empty: the first enabled one
    /// An expression in the parameters of the scene: the period of a drive, or where Newton's method begins.
    /// Empty: the length of the scene for a drive, else where the motion comes back nearest to its start.
    std::string period = {};
    std::optional<double> energy = {};  ///< empty: that of the start
    std::string hold = {};              ///< "energy" or "period"; empty: what the system has
    std::string follow = {};            ///< "energy=VALUE", "period=VALUE", "POINTER=VALUE"; empty: one orbit
    int points = 0;                     ///< about so many orbits of a family; 0: 20
    std::string manifold = {};          ///< "unstable" or "stable"; empty: not wanted
    int starts = 0;                     ///< of the manifold; 0: 200
};

struct OrbitAnswer {
    std::string scheme;  ///< its label
    OrbitKind kind = OrbitKind::conservative;
    OrbitHold hold = OrbitHold::nothing;
    long long steps = 0;
    std::vector<double> closes;  ///< gaps of the iterates of Newton's method, the guess first
    std::optional<PeriodicOrbit> orbit;
    std::string problem, remedy;  ///< why there is none, and what to do about it
    OrbitStability stability = OrbitStability::elliptic;
    /// The period, and the start over the size of the motion, less those of twice as many steps: what the
    /// scheme is off by, but for a part 1 / (2^order - 1) of it. NaN where that orbit was not found.
    double periodBias = std::numeric_limits<double>::quiet_NaN(), startBias = periodBias;
    OrbitFamily family;  ///< no rows: none was asked for
    std::optional<Manifold> manifold;
    /// Of the last orbit: its start, its period as the end, whole steps in it. With a manifold its starts are
    /// in a section, and the end is when they have left the orbit.
    Value scene;
    StudyTable table;  ///< orbits.csv: a row per orbit
    bool isFound() const { return orbit.has_value(); }
};

/// Throws InvalidScene, with options as pointers ("--period"), where the request cannot be met; that no orbit
/// is found is said in the answer.
OrbitAnswer seekOrbit(const ResolvedScene& scene, const OrbitRequest& request,
                      const std::stop_token& stop = {});

/// The answer as JSON, without the scene.
Value orbitValue(const OrbitAnswer& answer);

}  // namespace extremal
