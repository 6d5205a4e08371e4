// SPDX-License-Identifier: GPL-3.0-or-later
/// What baselines of fields share: the integrals over space with the mass at the nodes.
#pragma once

#include <memory>

#include "engine/model/field/spatial_form.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// By the Lobatto rule of the nodes of each element: the mass is diagonal.
inline std::shared_ptr<const SpatialForm> lumpedForm(const System& system) {
    const auto& problem = system.part<ScalarField>().problem;
    return std::make_shared<const SpatialForm>(problem, lobatto<double>(problem->nodes.degree + 1));
}

}  // namespace extremal
