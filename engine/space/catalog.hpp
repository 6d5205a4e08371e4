// SPDX-License-Identifier: GPL-3.0-or-later
/// Function spaces that are tables, by name and with the descriptors of their keys; one file of space/spaces
/// makes one entry. Families have further spaces of their own (engine/family).
#pragma once

#include <functional>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/space/space.hpp"

namespace extremal {

struct SpaceEntry {
    CatalogItem item;
    /// Keys are checked and complete. Empty: a space of a family that makes no table of it (engine/family).
    std::function<Space<double>(const Settings& settings)> make;
};

/// The spaces that are tables, in alphabetical order of their files; gathered from space/spaces.
const std::vector<SpaceEntry>& tableSpaces();

}  // namespace extremal
