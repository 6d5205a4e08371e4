// SPDX-License-Identifier: GPL-3.0-or-later
/// What the results of studies are in a scene: edits that load one of their runs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

/// The index of the scheme with this label; -1 where the scene has none.
int indexOfScheme(const Scene& scene, const std::string& label);

/// Gives a scheme, by its label, this step or tolerance (the other one is 0) and switches it on; empty where
/// the scene has no such scheme.
std::vector<Edit> editsForPoint(const Scene& scene, const std::string& label, double step, double tolerance);

/// Gives numbers of the scene, by their pointers, the values of a run of this scheme, and switches it on. A
/// pointer to all schemes ("/schemes/*/step") means this one alone. Empty where the scene has no such scheme.
std::vector<Edit> editsForRun(const Scene& scene, const std::string& label,
                              const std::vector<std::pair<std::string, double>>& numbers);

/// Puts a scheme in the place of the one with its label, or adds it where the scene has none.
std::vector<Edit> editsForScheme(Scene scene, const SchemeSpec& scheme);

}  // namespace extremal
