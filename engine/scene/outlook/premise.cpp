// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/premise.hpp"

#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

PremiseCheck::Run runOf(const Scene& scene, const State& initial) {
    return {scene.initial.given, initial, scene.start.value, scene.end.value};
}

}  // namespace

ExactPremise premiseOf(const Scene& scene, const System& system, const State& initial) {
    const PremiseCheck* const check = system.parts.find<PremiseCheck>();
    if (!check) return {};
    return check->premise(runOf(scene, initial), [&] { return exactSolution(scene, system, initial); });
}

bool isComputedInstead(const Scene& scene, const System& system) { return system.at && !isBackwards(scene); }

std::string residualFault(const Scene& scene, const System& system, const State& initial) {
    const PremiseCheck* const check = system.parts.find<PremiseCheck>();
    return check && check->fault ? check->fault(runOf(scene, initial)) : std::string();
}

}  // namespace extremal
