// SPDX-License-Identifier: GPL-3.0-or-later
/// What of the catalogues can be used on the scene's model: menus and editors offer nothing else.
#pragma once

#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/family/choices.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

struct BaselineEntry;
struct SchemeEntry;
struct System;

std::vector<CatalogItem> fittingSpaces(const Scene& scene);
std::vector<const BaselineEntry*> fittingBaselines(const Scene& scene);
std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene);

/// A grid of discretizations, and what is known of each cell.
struct DescribedGrid {
    ChoiceGrid choices;
    std::vector<Properties> known;  ///< of choices.cells
    /// What is known of a cell follows from its discretization.
    bool operator==(const DescribedGrid& other) const { return choices == other.choices; }
};
/// What the discretizer offers for a system: a grid for every family that applies, the usual one first. Takes
/// up to a few hundred milliseconds where nothing is known yet. From any thread. Throws nothing: there are no
/// grids where they cannot be made, and a cell that cannot be described is refused, with the reason.
std::vector<DescribedGrid> describedChoices(const System& system);
/// The first of these grids.
ChoiceGrid choicesFor(const Scene& scene);
/// The choice with this rule and the nearest degree, else the nearest degree with any rule; null where there
/// is none.
const ChoiceGrid::Cell* nearestChoice(const ChoiceGrid& grid, const std::string& rule, int degree);

}  // namespace extremal
