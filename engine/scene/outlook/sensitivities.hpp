// SPDX-License-Identifier: GPL-3.0-or-later
/// Which schemes say derivatives of their motion by numbers of the scene
/// (integrator/variation/with_sensitivities.hpp).
#pragma once

#include <memory>
#include <string>

#include "engine/integrator/integrator.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Why a scheme has none, or why one of them is not known, for people; empty: it has all. `start`: where its
/// run begins.
std::string sensitivityProblem(const ResolvedScene& scene, const ResolvedScheme& scheme,
                               const Integrator& integrator, double step, const State& start);

/// The integrator with its sensitivities; as it is where it has none.
std::unique_ptr<Integrator> measuringSensitivities(std::unique_ptr<Integrator> integrator,
                                                   const ResolvedScene& scene, const ResolvedScheme& scheme,
                                                   double step, const State& start);

}  // namespace extremal
