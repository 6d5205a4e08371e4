// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of the view "parameter-map": a grid of a parameter of the model and the step.
#pragma once

#include <vector>

#include "engine/core/field.hpp"

namespace extremal {

inline constexpr const char* mapView = "parameter-map";

const std::vector<FieldInfo>& mapFields();

}  // namespace extremal
