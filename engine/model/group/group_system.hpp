// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems on a group that is given as data: columns, start, energy, error, what is kept, and the stage.
#pragma once

#include <vector>

#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/parts/by_hand.hpp"
#include "engine/model/system.hpp"

namespace extremal::groups {

/// From the checked keys of the model `group`. Throws InvalidScene.
System systemOf(const Settings& settings);

/// x from /initial: g ("identity", rows, or {"exp": [..]}; of a product by factor), and one of xi and mu (of
/// a product by factor, or all in one list); of nothing at all, the identity with an example of xi. What is a
/// little off the group (1e-8) is taken to it.
std::vector<double> startOf(const GroupMechanics& mechanics, const Settings& initial);

/// Throws InvalidScene (pointers below /model) where L is degenerate at the state, with the direction.
void checkRegular(const GroupMechanics& mechanics, const State& initial);

/// A displacement by hand is one in the algebra, of g exp(hat by), at the same momentum in the body.
ByHand byHand(const GroupMechanics& mechanics);

/// Rotations of space as bodies side by side, and motions of the plane as a plate; nothing of other groups.
void describePicture(System& system, const GroupMechanics& mechanics);

}  // namespace extremal::groups
