// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes may come from strangers: what a scene names lies in the scene's own folder, or is read only where
/// the user agrees.
#pragma once

#include <string>

#include "engine/scene/scene.hpp"

namespace extremal {

/// The file outside `directory` that the scene would read, links followed; empty: there is none.
std::string fileOutside(const Scene& scene, const std::string& directory);

/// The scene as it is saved into `directory`: files in this folder are named relative to it, so that both can
/// be moved together.
Scene namedFrom(const std::string& directory, Scene scene);

}  // namespace extremal
