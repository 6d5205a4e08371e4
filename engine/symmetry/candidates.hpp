// SPDX-License-Identifier: GPL-3.0-or-later
/// Symmetries that have a name, to be tried, and the names of those that were found.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/symmetry/symmetry.hpp"

namespace extremal {

/// The direction of a coordinate, as its name says: "x" of "x", "x1", "x_2" and "sun.x".
std::string directionOf(const Coordinate& coordinate);

/// Translations, rotations and boosts of all bodies together along the directions that coordinates have; with
/// the translation of every single coordinate.
std::vector<Symmetry> candidates(const System& system);

/// Fills kind, name, title and generator of each; names are unique.
void nameAll(const System& system, std::span<Symmetry> symmetries);

}  // namespace extremal
