// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/local_errors.hpp"

#include <utility>

#include "engine/core/problem.hpp"
#include "engine/integrator/variation/with_local_errors.hpp"
#include "engine/scene/outlook/companion.hpp"

namespace extremal {

std::string localErrorProblem(const ResolvedScheme& scheme, const System& system,
                              const Integrator& integrator) {
    if (!system.hasCoordinates()) return "a state that is not of coordinates and momenta";
    if (!scheme.isFixed()) return "steps that it chooses itself";
    if (integrator.tangentSize() == 0) return "no tangent map";
    if (!integrator.memoryParts().empty())
        return "a memory, so that a step cannot be compared with a better one";
    if (!scheme.family && scheme.claims.order == 0) return "no claimed order to extrapolate its halves by";
    return {};
}

std::unique_ptr<Integrator> measuringLocalErrors(std::unique_ptr<Integrator> integrator,
                                                 const ResolvedScheme& scheme, const System& system,
                                                 double step, const State& start) {
    const int order = scheme.claims.order;
    if (scheme.family && !scheme.isComposed()) try {
            auto better = companionOf(scheme, system).make(system, step, start);
            return withLocalErrors(std::move(integrator), std::move(better), false, order);
        } catch (const InvalidScene&) {
            // The highest degree there is: halves of its step.
        }
    if (order == 0) return integrator;
    auto halves = scheme.make(system, step / 2, start);
    return withLocalErrors(std::move(integrator), std::move(halves), true, order);
}

}  // namespace extremal
