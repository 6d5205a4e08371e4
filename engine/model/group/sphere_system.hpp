// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems of points on spheres (model/group/spheres.hpp): columns, start, energy, error, what is kept, and
/// the stage.
#pragma once

#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/parts/by_hand.hpp"
#include "engine/model/system.hpp"

namespace extremal::spheres {

/// From the checked keys of the model `spheres`. Throws InvalidScene.
System systemOf(const Settings& settings);

/// Keys of the initial data: those of the names, and the same with _t.
std::vector<FieldInfo> startFields(const std::vector<std::string>& names);

/// x from /initial: points, which are normalised, and velocities, of which the part in the tangent plane is
/// taken. Throws InvalidScene, with pointers relative to /initial.
std::vector<double> startOf(const Spheres& on, const Settings& initial);

/// Where that has changed what is given by more than round-off.
std::vector<Problem> startNotesOf(const Spheres& on, const Settings& initial);

/// Throws InvalidScene (pointers below /model) where L is degenerate at the state, with the direction.
void checkRegular(const Spheres& on, const State& initial);

/// A displacement by hand is the way of each point in space, along its sphere; velocities turn with it.
ByHand byHand(const Spheres& on);

/// All points on one sphere, or as a chain of links of length 1.
void describePicture(System& system, const Spheres& on);

}  // namespace extremal::spheres
