// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the exact solution of a scene is that of its own problem over the whole run: the premises that its
/// formula makes of the ends of the domain. The problem itself tests them (model/parts/premise_check.hpp).
#pragma once

#include <string>

#include "engine/model/parts/premise_check.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// Costs less than a millisecond. Of scenes without an exact solution nothing is violated.
ExactPremise premiseOf(const Scene& scene, const System& system, const State& initial);

/// Whether "auto" computes a reference in place of an exact solution whose premise is violated: if the state
/// can be compared at other places than its nodes, and the run goes forwards.
bool isComputedInstead(const Scene& scene, const System& system);

/// What is wrong with a typed exact solution: that it does not solve the equation. Empty if
/// nothing is.
std::string residualFault(const Scene& scene, const System& system, const State& initial);

}  // namespace extremal
