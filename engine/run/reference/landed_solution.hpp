// SPDX-License-Identifier: GPL-3.0-or-later
/// The solution of an error-controlled code that ends a step at every time it is asked for, and at given
/// ones: as good there as its tolerance says, whatever its dense output is.
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "engine/run/reference/stepped_solution.hpp"

namespace extremal {

/// `ends`: further times at which a step ends, ascending; steps do not reach over them.
std::function<ExactSolution()> landed(MakeStepper make, const State& initial, std::vector<double> ends);

}  // namespace extremal
