// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/parts/references.hpp"

#include <utility>

#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/parameter_switching.hpp"
#include "engine/family/parts/variant.hpp"
#include "engine/integrator/at_switches.hpp"

namespace extremal {

ReferencePlan referenceBy(std::string description, const System& system, const Discretization& scheme) {
    ReferencePlan plan;
    plan.description = std::move(description);
    plan.make = [system, scheme](double step) {
        return withSwitchedParameters(system, {}, [scheme, step](const System& present, const State&) {
            return landingOnSwitches(present, [scheme, step](const System& smooth) {
                return makeIntegrator(smooth, scheme, {0, step});
            });
        });
    };
    return plan;
}

std::vector<ReferencePlan> referencePlans(const System& system, const State& start, double duration) {
    std::vector<ReferencePlan> all;
    const auto add = [&](const Family& family) {
        const auto* const trusted = family.parts.find<TrustedScheme>();
        if (!trusted || !appliesTo(family, system)) return;
        if (ReferencePlan plan = trusted->plan(system, start, duration); plan.make)
            all.push_back(std::move(plan));
    };
    for (const Family& family : families())
        if (isVariant(family, system)) add(family);
    if (const Family* const own = familyFor(system)) add(*own);
    return all;
}

std::unique_ptr<Integrator> trustedIntegrator(const System& system, const State& start, double step) {
    const Family* const family = familyFor(system);
    const auto* const trusted = family ? family->parts.find<TrustedScheme>() : nullptr;
    if (!trusted)
        throw InvalidScene("/reference", "no scheme of references is known for " + system.id, "take none");
    return trusted->plan(system, start, step).make(step);
}

}  // namespace extremal
