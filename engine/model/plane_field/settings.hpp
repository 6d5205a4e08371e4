// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of a model of fields with components: names, potential and wave speeds.
#pragma once

#include <string>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/plane_field/problem.hpp"

namespace extremal {

FieldInfo componentNamesField();
FieldInfo waveSpeedsField();

/// The names of the components. Throws InvalidScene.
std::vector<std::string> componentNames(const Settings& settings);

/// The field with these keys on a grid. Throws InvalidScene.
PlaneFieldProblem planeFieldOf(const Settings& settings, const wave::Grid& grid);

}  // namespace extremal
