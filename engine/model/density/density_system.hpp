// SPDX-License-Identifier: GPL-3.0-or-later
/// The System of a field with a typed density, and the model's settings as such a field.
///
/// Energy sum w (u_t . dL/du_t - L), momenta sum w dL/du_t (where L does not depend on u) and -sum w dL/du_t
/// u_x are those of hat functions by the rule Gauss 2 in each cell.
#pragma once

#include <memory>

#include "engine/core/settings.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Refuses a density that is degenerate in u_t at the start (checkDensityStart).
System makeDensitySystem(std::shared_ptr<const DensityProblem> problem);

/// Refuses keys beside a density that it takes the place of: potential, wave speed, mass and medium that are
/// not their defaults. Throws InvalidScene.
void refuseKeysBesideDensity(const Settings& model);

/// Throws InvalidScene where the state has no energy, or p does not say u_t there: d2L/du_t2 is singular.
void checkDensityStart(const DensityProblem& problem, const State& initial);

}  // namespace extremal
