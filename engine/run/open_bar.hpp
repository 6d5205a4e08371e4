/// From when on the difference from a companion is no estimate of the error any more: it is above 0.05 of the
/// size of the state, of systems with coordinates the rms of |q| over the rows.
#pragma once

#include "engine/run/comparison.hpp"

namespace extremal {

/// Fills Summary::opensAt and the caution. `initial`: of the run.
void judgeBar(SchemeResult& result, const System& system, const State& initial);

}  // namespace extremal
