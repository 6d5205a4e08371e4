// SPDX-License-Identifier: GPL-3.0-or-later
/// The better steps that local errors are measured by (integrator/variation/with_local_errors.hpp): of a
/// discretization those of its companion with one degree more, of others two halves of the step.
#pragma once

#include <memory>
#include <string>

#include "engine/integrator/integrator.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Why a scheme has no local errors, for people; empty: it has.
std::string localErrorProblem(const ResolvedScheme& scheme, const System& system,
                              const Integrator& integrator);

/// The integrator with its local errors; as it is where it has none.
std::unique_ptr<Integrator> measuringLocalErrors(std::unique_ptr<Integrator> integrator,
                                                 const ResolvedScheme& scheme, const System& system,
                                                 double step, const State& start);

}  // namespace extremal
