// SPDX-License-Identifier: GPL-3.0-or-later
/// Named schemes: discretizations under their usual names. One file of engine/family/<id>/schemes makes one
/// entry.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/family/family.hpp"

namespace extremal {

/// "galerkin-gauss-<s>" is one entry with a range of degrees s.
struct SchemeEntry {
    CatalogItem item;  ///< id "midpoint", or a family "galerkin-gauss-<s>"; its claims follow from the
                       ///< discretization (scheme_claims.hpp)
    std::string source;
    int minDegree = 0, maxDegree = 0;  ///< both 0: a single name; else ids end in the degree
    std::function<Discretization(int degree)> make;
};
const std::vector<SchemeEntry>& schemeCatalog();
/// Finds "midpoint" or "galerkin-gauss-3"; complete. Empty if there is none.
std::optional<Discretization> namedScheme(std::string_view id);

}  // namespace extremal
