// SPDX-License-Identifier: GPL-3.0-or-later
/// Which scheme of a scene a cell of the discretizer stands for.
#pragma once

#include "engine/family/choices.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// The scheme with the same space and rule, first of all one that is switched on, or -1. In a cell with
/// formulas (isOwn) are all schemes of its kinds of space and rule and its degree.
/// `keepsEnergy`: one that keeps the energy in place of the symplectic form.
int findScheme(const ResolvedScene& scene, const ChoiceGrid::Cell& cell, bool keepsEnergy = false);

}  // namespace extremal
