/// From when on the difference from a companion is no estimate of the error any more: it is above 0.05 of the
/// size of the state, of systems with coordinates the rms of |q| over the rows; from the start where steps do
/// not resolve the fastest motion (scene/companion.hpp), or many of the companion's steps failed.
#pragma once

#include <string>

#include "engine/run/comparison.hpp"
#include "engine/run/reference.hpp"

namespace extremal {

/// Fills Summary::opensAt and the caution. `initial`: of the run.
void judgeBar(SchemeResult& result, const System& system, const State& initial);

/// Fills the caution where there is no bar, for the reason given; and opens it from the start where more than
/// 2 % of the companion's steps had events (no root of the energy equation, ...): its own error may then be
/// the larger one.
void judgeCompanion(SchemeResult& result, const Reference& reference, const std::string& reason);

}  // namespace extremal
