/// What the views of a scene show of a pair beside its run: the pattern of its KKT matrix, the defect of its
/// action. Neither costs anything where no view asks for it.
#pragma once

#include <memory>
#include <stop_token>

#include "engine/family/galerkin/exact_actions.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

bool showsView(const Scene& scene, const char* id);

/// Exact actions for all pairs of the scene, in steps from twice their largest down; null where no view needs
/// them.
std::shared_ptr<ExactActions> exactActionsOf(const Scene& scene, const System& system, const State& initial);

/// `start`: the scheme's own; it differs from that of the scene where two positions are given.
void lookAtPair(SchemeResult& result, const Scene& scene, const System& system, const State& start,
                ExactActions* exact, const std::stop_token& stop);

}  // namespace extremal
