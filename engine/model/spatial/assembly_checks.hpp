// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong with elements in space that are well formed each by itself: moments that no body has,
/// joints, lengths and ends. Internal to engine/model/spatial.
#pragma once

#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

/// Empty where all is well; finds the flat bodies.
std::vector<Problem> problemsOf(Assembly& assembly);

}  // namespace extremal::spatial
