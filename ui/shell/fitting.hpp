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

/// What the discretizer offers for the scene's model: a grid of every family that applies, the usual one
/// first.
std::vector<ChoiceGrid> choiceGrids(const Scene& scene);
/// The first of them.
ChoiceGrid choicesFor(const Scene& scene);
/// The choice with this rule and the nearest degree, else the nearest degree with any rule; null where there
/// is none.
const ChoiceGrid::Cell* nearestChoice(const ChoiceGrid& grid, const std::string& rule, int degree);

}  // namespace extremal
