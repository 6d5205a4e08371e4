// SPDX-License-Identifier: GPL-3.0-or-later
/// The initial data that have names: profiles of fields (the key `profile`) and packets of wave functions
/// (the key `packet` of `psi`).
#pragma once

#include <vector>

#include "engine/core/catalog.hpp"

namespace extremal {

/// Of fields over a line, over rectangles, then of wave functions; `needs` says which. All have a
/// `plane-wave`.
const std::vector<CatalogItem>& profileCatalog();

}  // namespace extremal
