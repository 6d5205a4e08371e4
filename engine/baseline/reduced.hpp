// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines that integrate a slow model in place of a system with a fast oscillation (ReducedModel of
/// model/system.hpp), by the classical Runge-Kutta method of order 4. Their error does not go to zero with
/// the step: it is that of the model.
#pragma once

#include "engine/baseline/catalog.hpp"

namespace extremal {

/// The baseline of the reduced models with this id.
BaselineEntry reducedBaseline(const std::string& id, const std::string& title,
                              const std::string& description);

}  // namespace extremal
