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

std::vector<CatalogItem> fittingSpaces(const Scene& scene);
std::vector<const BaselineEntry*> fittingBaselines(const Scene& scene);
std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene);

/// A grid of discretizations, and what is known of each cell.
struct DescribedGrid {
    ChoiceGrid choices;
    std::vector<Properties> known;  ///< of choices.cells
    bool operator==(const DescribedGrid& other) const { return choices == other.choices; }
};
/// What the discretizer offers for a model: a grid of every family that applies, the usual one first. Takes
/// up to a few hundred milliseconds where nothing is known yet. From any thread; throws nothing: where the
/// model admits no grid there is none, and a cell that cannot be described says why as a refusal.
std::vector<DescribedGrid> describedChoices(const Settings& model);
/// The first of these grids.
ChoiceGrid choicesFor(const Scene& scene);
/// The choice with this rule and the nearest degree, else the nearest degree with any rule; null where there
/// is none.
const ChoiceGrid::Cell* nearestChoice(const ChoiceGrid& grid, const std::string& rule, int degree);

}  // namespace extremal
