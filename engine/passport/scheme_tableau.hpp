// SPDX-License-Identifier: GPL-3.0-or-later
/// The tableau of a scheme of a scene.
#pragma once

#include <memory>
#include <string>

#include "engine/scene/resolve.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {

/// Of the step as it is in the scene, composition included; null where there is none, and then the reason.
std::shared_ptr<const Tableau> tableauOf(const ResolvedScene& scene, const ResolvedScheme& scheme,
                                         std::string& reason);

}  // namespace extremal
