// SPDX-License-Identifier: GPL-3.0-or-later
/// The products that show the equations of a discretization beside its run: the pattern of its KKT matrix,
/// the defect of its action. A scheme that has none says why.
#pragma once

#include <memory>
#include <stop_token>

#include "engine/run/exact_actions.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// Exact actions for all discretizations of the scene, in steps from twice their largest down; null where the
/// plan does not ask for them.
std::shared_ptr<ExactActions> exactActionsOf(const ResolvedScene& scene, const ProductPlan& plan);

/// Adds those of the plan. `start`: the scheme's own; it differs from that of the scene where two positions
/// are given.
void addEquations(SchemeResult& result, const ProductPlan& plan, const ResolvedScene& scene,
                  const ResolvedScheme& scheme, const State& start, ExactActions* exact,
                  const std::stop_token& stop);

}  // namespace extremal
