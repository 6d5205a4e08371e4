/// What of the catalogues can be used on the scene's model: menus and editors offer nothing else.
#pragma once

#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

struct BaselineEntry;
struct SchemeEntry;

std::vector<CatalogItem> fittingSpaces(const Scene& scene);
std::vector<const BaselineEntry*> fittingBaselines(const Scene& scene);
std::vector<const SchemeEntry*> fittingSchemes(const Scene& scene);

/// The id of the space that pairs are made of: polynomial for models with coordinates, lie-polynomial for
/// bodies.
std::string pairSpace(const Scene& scene);

}  // namespace extremal
