// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion on a group, or on spheres, as equations of first order for the numbers of the state, for
/// methods that know no group: they leave it by their errors.
///
///     g' = g hat eta,   mu' = ad_eta^T mu + f,   J' = Ad_{g^-1}^T f;      x' = w x x,   pi' = R f
///
/// States have an even number of entries, so that such methods take the first half of them in the place of q
/// and the other half in that of p.
#pragma once

#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

/// Entries of a state on a group: behind an odd number is one that stays 0.
int evenStateSize(const GroupMechanics& mechanics);

bool isOnGroup(const System& system);
/// flow and energy alone.
Mechanics<double> groupFlowOf(const System& system);
/// Whether mechanics were made by it.
bool isGroupFlow(const Mechanics<double>& mechanics);

}  // namespace extremal
