/// Function spaces by name, with the descriptors of their keys.
#pragma once

#include <vector>

#include "engine/core/catalog.hpp"

namespace extremal {
const std::vector<CatalogItem>& spaceCatalog();
}
