// SPDX-License-Identifier: GPL-3.0-or-later
/// Events that reflect: walls whose gap is the expression of the event.
///
/// `down`: the motion stays where the expression is positive, `up`: where it is negative. The expression is
/// one of places and t, as the gap of a wall, and the impulse is along its gradient: what is said of walls
/// holds (model/parts/wall.hpp, mechanism/impact_step.hpp), and who does not take walls refuses the scene.
/// They come behind the walls of the model.
#pragma once

#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// What is wrong with an event that reflects, with a message and a hint; empty: nothing.
std::vector<Problem> reflectionProblems(const EventSpec& event, const System& system);

/// The walls of the events of a scene, as a part of its system.
void addReflections(System& system, const std::vector<EventSpec>& events);

}  // namespace extremal
