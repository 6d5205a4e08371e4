// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/varied_motion.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/integrator/variation/held_coordinates.hpp"
#include "engine/integrator/variation/held_step.hpp"
#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/model/parts/force.hpp"

namespace extremal {
namespace {

/// A code that chooses its steps takes any at this tolerance, so that those of the run are taken as they are.
constexpr double anyStep = 1e6;

/// The scheme with the parameters as numbers; null where it cannot be.
std::unique_ptr<Integrator> heldMotion(const ResolvedScene& scene, const ResolvedScheme& scheme, double step,
                                       const State& start, const VariedMotion& along, bool hasIntegral) {
    const auto* const nodes = dynamic_cast<const TransposedStep*>(along.integrator.get());
    const Takes taken = Takes::only<Mechanical, Force>();
    if (!nodes || !nodes->hasNodes() || scheme.ownSystem || !isTaken(taken, scene.system->parts) ||
        !isTaken(taken, along.varied.system->parts))
        return nullptr;
    const System& whole = *along.varied.system;
    const Force* const force = whole.parts.find<Force>();
    const HeldCoordinates held(whole.mechanics(), force ? std::optional(*force) : std::nullopt,
                               along.varied.parameters);
    System system = *scene.system;
    system.parts.set(held.mechanics());
    if (auto own = held.force()) system.parts.set(*std::move(own));
    return heldStep(scheme.make(system, step, start), held,
                    hasIntegral ? std::optional(along.varied.integral) : std::nullopt);
}

}  // namespace

std::string differentiationProblem(const ResolvedScene& scene, const ResolvedScheme& scheme,
                                   const Integrator& integrator) {
    const System& system = *systemOf(scene, scheme);
    if (!system.hasCoordinates()) return "a state that is not of coordinates and momenta";
    if (scheme.grid == TimeGrid::free) return "steps whose times are unknowns";
    if (integrator.tangentSize() != 2 * system.coordinates.size()) return "no tangent map";
    if (scheme.isFixed() && !integrator.memoryParts().empty()) return "a memory besides its state";
    return {};
}

VariedMotion variedMotion(const ResolvedScene& scene, const ResolvedScheme& scheme, double step,
                          const State& start, VariedDirection direction, const VariedExtras& extras) {
    VariedMotion along;
    try {
        along.varied = variedScene(scene, extras);
        if (!along.varied.system) return along;
        const std::size_t d = scene.system->coordinates.size(), u = along.varied.parameters.size();
        along.start = start;
        along.start.x.insert(along.start.x.end(), u, 0.0);
        along.start.x.insert(along.start.x.begin() + static_cast<std::ptrdiff_t>(d),
                             along.varied.parameters.begin(), along.varied.parameters.end());
        ResolvedScheme same = scheme;
        if (scheme.isAdaptive()) same.spec.tolerance = anyStep;
        along.integrator = same.make(*along.varied.system, step, along.start);
        if (along.integrator->tangentSize() != along.start.x.size())
            along.problem = "no tangent map on formulas with the parameters as coordinates";
        if (along.problem.empty() && direction == VariedDirection::backward)
            if (auto held = heldMotion(scene, same, step, start, along, !extras.integrand.empty()))
                along.integrator = std::move(held);
    } catch (const InvalidScene& e) {
        if (!e.problems().empty()) along.place = e.problems().front().pointer;
        along.problem = e.problems().empty() ? "no such derivative" : e.problems().front().message;
    }
    return along;
}

}  // namespace extremal
