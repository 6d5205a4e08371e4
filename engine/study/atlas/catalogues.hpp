// SPDX-License-Identifier: GPL-3.0-or-later
/// All catalogues by their names, as `extremal list`, completions and the library show them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/value.hpp"

namespace extremal {

struct Catalogue {
    std::string name;  ///< "models", "spaces", ...
    std::vector<CatalogItem> items;
    std::vector<Value> more = {};  ///< further members of each item; may be empty
};

/// In the order in which they are listed.
const std::vector<Catalogue>& catalogues();
/// Null where there is none of this name.
const Catalogue* findCatalogue(std::string_view name);

/// An array of objects: id, title, description, parameters (key, type, unit, default, min, max, description);
/// schemes and baselines also claims and needs.
Value catalogueValue(const Catalogue& catalogue);

}  // namespace extremal
