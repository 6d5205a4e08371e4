/// What a scheme will cost, from a few trial steps: for warnings beforehand, and for proposals.
#pragma once

#include "engine/model/system.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// CPU seconds of the scheme's steps from the start to the end of the scene, without reference and output:
/// the mean cost of trial steps from the initial state (at most some 3 ms of them) times the number of steps.
/// For adaptive baselines the number of steps follows from how far the trial steps came. 0 if a trial step
/// fails.
double predictSeconds(const ResolvedScene& scene, const ResolvedScheme& scheme);

}  // namespace extremal
