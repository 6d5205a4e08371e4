// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data on the constraints.
///
/// Places that miss g = 0 by round-off of what was typed are moved there, others only where the scene asks
/// for it; momenta are always projected, as a step does it at its end.
#pragma once

#include <string>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Moves a state (q, p) onto the constraints of a system, which may have none. `movesFar`: also where q
/// changes by more than 1e-6. Throws InvalidScene: /initial/q where it misses a constraint, with the places
/// that would do; /model/constraints where constraints contradict or repeat each other there.
void putOnConstraints(const System& system, State& state, bool movesFar);

/// Throws InvalidScene: /initial/q where the state is inside a wall by more than rounding.
void requireOutsideWalls(const System& system, const State& state);

/// What the constraints at the start make of momenta, where that is worth a word ("changes p.x by 0.3: ..");
/// empty: nothing. `given`: the momenta before.
std::string projectionNote(const System& system, const State& given, const State& projected);

}  // namespace extremal
