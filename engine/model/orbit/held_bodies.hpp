// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the potential of a system is that of bodies of which one holds all others.
#pragma once

#include <optional>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/held_bodies.hpp"

namespace extremal {

/// The coordinates are to be those of bodies in space or in a plane, one body after the other or one axis
/// after the other, with constant masses, and V = -sum_{i<j} K_ij / |q_i - q_j| - sum_i K_i / |q_i|, with at
/// least two pulls. The centre is the origin where that pulls all of them, else the heaviest body; it has
/// ten times the pull on each of all the others, and as a body ten times their mass. Found from values of the
/// potential at random places, to 1e-10 of it; nothing where it is not so.
std::optional<HeldBodies> heldBodiesIn(const Mechanics<double>& mechanics);

}  // namespace extremal
