// SPDX-License-Identifier: GPL-3.0-or-later
/// A family of periodic orbits along one number: the energy, the period, or a number of the scene.
///
/// With y the unknowns of one orbit and s the number, each over its size, the equations F(y, s) = 0 define a
/// curve, which is followed by its length,
///
///     F(y, s) = 0,   (y - y_*) . y_t + (s - s_*) s_t = 0,      (y_*, s_*) = last + length (y_t, s_t),
///
/// with the chord of the last two orbits as the direction (y_t, s_t), so that it goes on where the number
/// turns round. A correction is the one of least norm (periodic_orbit.hpp). Where Newton's method fails the
/// length is halved. The last orbit is that of the wanted value itself.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/study/orbits/orbit_search.hpp"

namespace extremal {

/// Where the family goes: from the value that the first orbit has.
struct OrbitPath {
    std::string name;  ///< "energy", "period", or a pointer into the scene
    double to = 0;
    int points = 20;  ///< about so many orbits
    /// Of a forced motion the period, of the scene with another value of the number.
    std::function<double(const ResolvedScene&)> periodOf = {};
};

/// `equations` are those of the first orbit, which is found. Throws InvalidScene ("--follow") where the path
/// is not one.
OrbitFamily followFamily(const ResolvedScene& scene, std::size_t scheme, OrbitEquations& equations,
                         const PeriodicOrbit& first, const OrbitPath& path, const std::stop_token& stop = {});

}  // namespace extremal
