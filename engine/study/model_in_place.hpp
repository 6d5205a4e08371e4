// SPDX-License-Identifier: GPL-3.0-or-later
/// Schemes that integrate a model in place of the system of a scene.
#pragma once

#include <cstddef>
#include <string>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// What the scheme has in place of the system: "rigid pendulum", "rod"; empty of schemes that integrate the
/// system itself.
std::string modelInPlace(const ResolvedScheme& scheme, const System& system);
/// "rod in place of spring-pendulum", of a scheme of the scene; or empty.
std::string modelInPlace(const ResolvedScene& scene, std::size_t scheme);

}  // namespace extremal
