// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/reductions.hpp"

#include "engine/core/problem.hpp"
#include "engine/core/set_key.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/study/search/ladder.hpp"

namespace extremal {
namespace {

int wholeNumber(const Settings& settings, const char* key) {
    const Value* value = settings.find(key);
    return value && value->isNumber() ? settings.integer(key) : 0;
}

/// Null: the step is not proportional to a key of the space.
const char* factorKey(const ResolvedScheme& scheme) {
    const auto* const own = scheme.family ? scheme.family->parts.find<StepOfSpace>() : nullptr;
    return own ? own->factor : nullptr;
}

/// The smaller spaces of a scheme with the degree of a reduction; empty: it has none.
std::vector<SmallerSpace> smallerSpacesOf(const ResolvedScheme& scheme, const Reduction& to,
                                          const ResolvedScene& scene) {
    const auto* const smaller = scheme.family ? scheme.family->parts.find<SmallerSpaces>() : nullptr;
    if (!smaller || scheme.isComposed() || scheme.isTested()) return {};
    Settings space = scheme.discretization.space;
    if (to.degree > 0) setKey(space, "degree", static_cast<double>(to.degree));
    return smaller->of(space, scene.scene.model);
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
    const auto* const finer = scheme.family ? scheme.family->parts.find<RefinedMesh>() : nullptr;
    const bool isPlain = finer && isTaken(finer->of, scene.system->parts) &&
                         scheme.family->parts.find<OwnMesh>() && scheme.orderInSpace() > 0;
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
        setKey(spec.solver, "tolerance", to.solver);
    }
    if (to.degree > 0 || to.cells > 0 || to.stepFactor > 0 || to.smaller > 0) {
        spec.kind = SchemeSpec::Kind::discretization;
        spec.named.clear();
        spec.space = scheme.discretization.space;
        spec.quadrature = scheme.discretization.quadrature;
    }
    if (to.degree > 0) {
        setKey(spec.space, "degree", static_cast<double>(to.degree));
        setKey(spec.quadrature, "nodes", static_cast<double>(to.nodes));
    }
    if (to.smaller > 0) {
        const std::vector<SmallerSpace> all = smallerSpacesOf(scheme, to, scene);
        const auto at = static_cast<std::size_t>(to.smaller) - 1;
        if (at >= all.size())
            throw InvalidScene("/space", "has no smaller space of number " + std::to_string(to.smaller));
        spec.space = all[at].space;
        // A rule that was chosen for the whole space is chosen again.
        if (to.degree == 0) spec.quadrature = scheme.spec.quadrature;
        if (spec.quadrature.type.empty()) spec.quadrature.type = "auto";
    }
    if (to.cells > 0) setKey(spec.space, "cells", static_cast<double>(to.cells));
    if (to.stepFactor > 0) {
        const char* const key = factorKey(scheme);
        const double own = scheme.discretization.space.number(key);
        setKey(spec.space, key, to.stepFactor);
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

std::vector<SmallerReduction> smallerReductionsOf(const ResolvedScheme& scheme, const Reduction& reduction,
                                                  const ResolvedScene& scene) {
    std::vector<SmallerReduction> all;
    const std::vector<SmallerSpace> spaces = smallerSpacesOf(scheme, reduction, scene);
    for (std::size_t i = 0; i < spaces.size(); ++i) {
        Reduction to = reduction;
        to.smaller = static_cast<int>(i) + 1;
        try {
            (void)reduced(scheme, to, scene);
            all.push_back({to, spaces[i].share});
        } catch (const InvalidScene&) {
            continue;  // it does not exist
        }
    }
    return all;
}

bool areSmallerNested(const ResolvedScheme& scheme) {
    const auto* const smaller = scheme.family ? scheme.family->parts.find<SmallerSpaces>() : nullptr;
    return smaller && smaller->areNested;
}

std::string textOfSmaller(const ResolvedScheme& scheme, const Reduction& reduction,
                          const ResolvedScene& scene) {
    const std::vector<SmallerSpace> all = smallerSpacesOf(scheme, reduction, scene);
    const auto at = static_cast<std::size_t>(reduction.smaller) - 1;
    return reduction.smaller > 0 && at < all.size()
               ? scheme.family->parts.find<SmallerSpaces>()->text(all[at].space)
               : std::string();
}

}  // namespace extremal
