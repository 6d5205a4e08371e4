// SPDX-License-Identifier: GPL-3.0-or-later
/// What spaces of Fourier modes for fields need of a model, and the model that they make of it.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/settings.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

inline constexpr int leastModes = 4, mostModes = 16384;

/// Fields over a rectangle, and those of the model `field` with linear elasticity.
bool isForModes(const System& system);
/// Why a field over an interval cannot have Fourier modes; nothing where it can.
std::optional<Problem> modesProblem(const FieldProblem& problem);
/// A periodic model as trigonometric polynomials, on as many nodes as the space has modes where it says so;
/// others stay as they are, to be refused.
std::optional<Settings> trigonometricModel(const Settings& space, const Settings& model);
/// Of a space on the line with the key `modes`: SmallerSpaces::of.
std::vector<SmallerSpace> fewerModes(const Settings& space, const Settings& model);

}  // namespace extremal
