// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of motion of a typed model, for people, whatever it is typed as:
///
///     lagrangian    d/dt ∂L/∂v − ∂L/∂q = forces and reactions    (typed/part_equations.hpp)
///     hamiltonian   q′ = ∂H/∂p,  p′ = −∂H/∂q
///     phase-space   Σ_j Om_ij x_j′ = ∂H/∂x_i,  Om_ij = ∂_i θ_j − ∂_j θ_i, by rows
///     poisson       x_i′ = Σ_j J_ij ∂H/∂x_j
///
/// A row of a one-form whose left-hand side would start with a sign is given with the opposite one.
/// Errors: ExpressionError and InvalidScene, of formulas that cannot be read.
#pragma once

#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::typed {

/// Whether a model of this type has equations that can be written.
bool hasMotionLines(const Settings& model);

/// One line per equation; empty for a model that is not typed, and for formulas that would fill pages.
std::vector<std::string> motionLines(const Settings& model, TextForm form);

/// The same as an environment of TeX, aligned at the equals signs; empty where there are none.
std::string texOfMotion(const Settings& model);

}  // namespace extremal::typed
