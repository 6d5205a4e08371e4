// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/sensitivities.hpp"

#include <utility>
#include <vector>

#include "engine/scene/outlook/varied_motion.hpp"

namespace extremal {

std::string sensitivityProblem(const ResolvedScene& scene, const ResolvedScheme& scheme,
                               const Integrator& integrator, double step, const State& start) {
    const std::string own = differentiationProblem(scene, scheme, integrator);
    if (!own.empty()) return "it has " + own;
    const VariedMotion along = variedMotion(scene, scheme, step, start, VariedDirection::forward);
    return along.problem.empty() ? along.varied.problem : along.problem;
}

std::unique_ptr<Integrator> measuringSensitivities(std::unique_ptr<Integrator> integrator,
                                                   const ResolvedScene& scene, const ResolvedScheme& scheme,
                                                   double step, const State& start) {
    if (!differentiationProblem(scene, scheme, *integrator).empty()) return integrator;
    VariedMotion along = variedMotion(scene, scheme, step, start, VariedDirection::forward);
    if (!along.problem.empty()) return integrator;
    std::vector<std::string> entries;
    for (const Quantity& entry : stateColumns(*systemOf(scene, scheme))) entries.push_back(entry.name);
    return withSensitivities(std::move(integrator), std::move(along.integrator),
                             std::move(along.varied.parameters), std::move(along.varied.numbers), entries);
}

}  // namespace extremal
