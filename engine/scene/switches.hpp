// SPDX-License-Identifier: GPL-3.0-or-later
/// Events that switch: a parameter of the model takes another value where their expression passes zero.
///
/// Which parameters can is a question to the model: what has another state (the number of its bodies), other
/// constraints or other walls with the other value would move bodies at a single time. Of a system that is
/// switched no exact solution is known, and neither is what else was known of its motion with one value.
#pragma once

#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// What is wrong with an event that switches, with a message and a hint; empty: nothing. `scene`: its model.
std::vector<Problem> switchProblems(const EventSpec& event, const Scene& scene, const System& system);

/// The switches of the events of a scene, as a part of its system.
void addSwitches(System& system, const Scene& scene);

}  // namespace extremal
