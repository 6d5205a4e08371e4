// SPDX-License-Identifier: GPL-3.0-or-later
/// The invariant manifolds of a periodic orbit, as a cloud of starts in a section.
///
/// In the section an orbit is a fixed point z of the map from one passage to the next, with the multipliers
/// of the orbit. For a real one, |lambda| > 1, with the eigenvector v of M = d Phi / d x, moved along the
/// flow into the section, v - f v_at / f_at, the points
///     z +- s v,   s = eps |lambda|^(k / n),   k = 0, .., n - 1,
/// lie on the unstable manifold but for terms of eps^2, and each of these intervals is mapped onto the next
/// one: what n motions pass in the section fills the manifold. The stable one, |lambda| < 1, is that of the
/// motion backwards in time.
#pragma once

#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/resolve.hpp"
#include "engine/study/orbits/orbit_facts.hpp"
#include "engine/view/plane.hpp"

namespace extremal {

struct Manifold {
    double multiplier = 1;                          ///< lambda
    std::vector<std::pair<double, double>> starts;  ///< places in the section
    double time = 0;                                ///< until they are as far away as the motion is large
};

/// Of an orbit that a scheme of the scene has with so many steps. `name`: "unstable" or "stable"; `count`: of
/// the starts, an even number. Throws InvalidScene ("--manifold") where there is no such manifold, or the
/// orbit does not pass the section.
Manifold manifoldOf(std::shared_ptr<const ResolvedScene> scene, std::size_t scheme, long long steps,
                    const PeriodicOrbit& orbit, const ViewPlane& section, const std::string& name, int count,
                    const std::stop_token& stop = {});

}  // namespace extremal
