// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of a scene as a formula.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/typed/formula.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// That of a typed Lagrangian, or what the model says (ModelEntry::lagrangian); empty: there is none.
std::optional<typed::Formula> formulaOf(const ResolvedScene& scene);

/// Ids of the models that say theirs.
std::vector<std::string> modelsWithFormula();

}  // namespace extremal
