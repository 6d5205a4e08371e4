/// Names of what can be observed and seen; the observables themselves are in observe/observables, one file each.
#pragma once

#include <vector>

#include "engine/core/catalog.hpp"

namespace extremal {

const std::vector<CatalogItem>& observableCatalog();
const std::vector<CatalogItem>& viewCatalog();

}  // namespace extremal
