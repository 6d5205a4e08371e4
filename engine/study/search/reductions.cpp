// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/reductions.hpp"

#include "engine/core/problem.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/study/search/ladder.hpp"

namespace extremal {
namespace {

int wholeNumber(const Settings& settings, const char* key) {
    const Value* value = settings.find(key);
    return value && value->isNumber() ? settings.integer(key) : 0;
}

void set(Settings& settings, const char* key, double value) {
    bool isThere = false;
    for (auto& [name, present] : settings.keys)
        if (name == key) present = value, isThere = true;
    if (!isThere) settings.keys.emplace_back(key, value);
    std::erase_if(settings.expressions, [&](const Value::Member& m) { return m.first == key; });
}

/// Null: the step is not proportional to a key of the space.
const char* factorKey(const ResolvedScheme& scheme) {
    const auto* const own = scheme.family ? scheme.family->parts.find<StepOfSpace>() : nullptr;
    return own ? own->factor : nullptr;
}

}  // namespace

Reduction richnessOf(const ResolvedScheme& scheme) {
    if (!scheme.family || scheme.isComposed() || scheme.isTested()) return {};
    const Reduction has{wholeNumber(scheme.discretization.space, "degree"),
                        wholeNumber(scheme.discretization.quadrature, "nodes")};
    return has.degree > 0 && has.nodes > 0 ? has : Reduction{};
}

int cellsOf(const ResolvedScheme& scheme, const ResolvedScene& scene) {
    // Functions of their own are made for the medium, and their error does not fall like a power.
    const bool isPlain = scheme.family && scheme.family->parts.find<OwnMesh>() &&
                         scheme.family->parts.find<RefinedMesh>() && scheme.orderInSpace() > 0;
    const Value* const functions = isPlain ? scheme.discretization.space.find("functions") : nullptr;
    if (!isPlain || (functions && *functions != Value("lagrange"))) return 0;
    const int own = wholeNumber(scheme.discretization.space, "cells");
    return own > 0 ? own : wholeNumber(scene.scene.model, "cells");
}

double stepFactorOf(const ResolvedScheme& scheme, const ResolvedScene& scene) {
    const char* const key = factorKey(scheme);
    if (!key || !hasStepOfItsSpace(scene, scheme)) return 0;
    const Value* const given = scheme.discretization.space.find(key);
    return given && given->isNumber() ? given->asNumber() : 0;
}

ResolvedScheme reduced(const ResolvedScheme& scheme, const Reduction& to, const ResolvedScene& scene) {
    if (!to) return scheme;
    SchemeSpec spec = scheme.spec;
    if (to.solver > 0) {
        if (spec.solver.type.empty()) spec.solver.type = "auto";
        std::erase_if(spec.solver.keys, [](const Value::Member& m) { return m.first == "tolerance"; });
        spec.solver.keys.emplace_back("tolerance", to.solver);
    }
    if (to.degree > 0 || to.cells > 0 || to.stepFactor > 0) {
        spec.kind = SchemeSpec::Kind::discretization;
        spec.named.clear();
        spec.space = scheme.discretization.space;
        spec.quadrature = scheme.discretization.quadrature;
    }
    if (to.degree > 0) {
        set(spec.space, "degree", to.degree);
        set(spec.quadrature, "nodes", to.nodes);
    }
    if (to.cells > 0) set(spec.space, "cells", to.cells);
    if (to.stepFactor > 0) {
        const char* const key = factorKey(scheme);
        const double own = scheme.discretization.space.number(key);
        set(spec.space, key, to.stepFactor);
        spec.step = {scheme.spec.step.value * to.stepFactor / own, {}};
    }
    ResolvedScheme result = resolve(spec, scene.system.get());
    if (!result.properties.refusal.empty()) throw InvalidScene("/quadrature", result.properties.refusal);
    if (!result.properties.instability.empty()) throw InvalidScene("/space", result.properties.instability);
    resolveSystem(result, scene.scene);
    return result;
}

std::vector<Reduction> reductionsOf(const ResolvedScheme& scheme, const ResolvedScene& scene) {
    std::vector<Reduction> all;
    const Reduction has = richnessOf(scheme);
    for (int degree = has.degree; degree >= 1; --degree)
        for (int nodes = has.nodes - (has.degree - degree); nodes >= degree; --nodes) {
            if (Reduction{degree, nodes} == has) continue;
            try {
                (void)reduced(scheme, {degree, nodes}, scene);
                all.push_back({degree, nodes});
            } catch (const InvalidScene&) {
                continue;  // too few nodes for the degree
            }
        }
    return all;
}

}  // namespace extremal
