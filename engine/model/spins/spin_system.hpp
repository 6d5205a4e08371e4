// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems of spins (model/spins/spins.hpp): columns, start, energy, error, what is kept, and the stage.
#pragma once

#include <string>
#include <vector>

#include "engine/model/spins/spins.hpp"
#include "engine/model/system.hpp"

namespace extremal::spins {

/// On one sphere, or as arrows side by side.
enum class SpinPicture { arrows, points };

System systemOf(const std::string& id, const SpinModel& model, SpinPicture picture);

/// The key of the initial data, a list of vectors.
FieldInfo startField(const char* title);

/// A list of numbers, none of which is 0. Throws InvalidScene.
std::vector<double> weightsOf(const Value& given, const std::string& pointer);

/// Throws InvalidScene (pointer below /model) where H has no finite derivatives at a state.
void checkFinite(const System& system, const State& initial, const char* pointer);

}  // namespace extremal::spins
