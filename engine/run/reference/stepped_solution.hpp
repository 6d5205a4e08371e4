// SPDX-License-Identifier: GPL-3.0-or-later
/// Solutions that are stepped as far as they are asked for, and the distance of two of them.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

/// The step that a solution could not take.
struct StepFailure {
    Outcome outcome = Outcome::converged;  ///< of no step
    double t = 0;                          ///< where it began
};

using MakeStepper = std::function<std::unique_ptr<Integrator>()>;

/// `end`: where error-controlled codes land, unless they are asked beyond it.
std::function<ExactSolution()> stepped(MakeStepper make, const State& initial, double end,
                                       const std::shared_ptr<StepCounts>& counts = nullptr,
                                       const std::shared_ptr<StepFailure>& failure = nullptr);

/// Largest distance of two solutions at times spread over the run; infinity where one is not known.
/// `atNodes`: at nodes alone, which both have if b has steps of `step`: inside a step the solution of some is
/// not read off but made anew.
double solutionDistance(const ExactSolution& a, const ExactSolution& b, double step, bool atNodes,
                        const Scene& scene, const System& system, const State& initial,
                        const std::stop_token& stop);

}  // namespace extremal
