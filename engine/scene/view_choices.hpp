// SPDX-License-Identifier: GPL-3.0-or-later
/// What the keys of a view may name in a scene: for the reader, which refuses the rest, and for menus.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {

/// The views of a scene; without any, those that its observables suggest.
std::vector<View> shownViews(const Scene& scene);

/// Why a scheme has nothing that the view shows; empty where it has. Most views show every scheme.
std::string unsuitableFor(const ViewEntry& view, const ResolvedScheme& scheme);

/// What `x` and `y` of a view may be. Makes the start of the scene, to know what its observables write.
std::vector<std::string> columnsFor(const std::string& view, const Scene& scene, const System& system);
/// What `at` may be: the state columns.
std::vector<std::string> zerosFor(const System& system);
/// What `scheme` may be.
std::vector<std::string> labelsOf(const Scene& scene);
/// What `node` may be at most; from 1.
int lastNodeOf(const Scene& scene);

}  // namespace extremal
