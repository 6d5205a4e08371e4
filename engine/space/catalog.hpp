/// Function spaces by name, with the descriptors of their keys; one file of space/spaces makes one entry.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/model/system.hpp"
#include "engine/space/space.hpp"

namespace extremal {

struct SpaceEntry {
    CatalogItem item;
    std::function<Space<double>(const Settings& settings)> make;  ///< keys are checked and complete
    std::function<bool(const System&)> applies;                   ///< empty: every system with coordinates
};

/// All spaces, in alphabetical order of their files; gathered from space/spaces.
const std::vector<SpaceEntry>& spaceEntries();
/// The same as catalogue items.
const std::vector<CatalogItem>& spaceCatalog();

}  // namespace extremal
