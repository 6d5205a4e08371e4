// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/candidates.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/scene/bind.hpp"
#include "engine/study/search/ladder.hpp"

namespace extremal {
namespace {

std::string textOf(const Value& scheme, const char* key) {
    const Value* const value = scheme.find(key);
    return value && value->isString() ? value->asString() : std::string();
}

/// By its name alone: another step, or keys of its own, make it no other candidate.
bool hasScheme(const Scene& scene, const Value& candidate) {
    const std::string named = textOf(candidate, "scheme"), baseline = textOf(candidate, "baseline");
    return std::any_of(scene.schemes.begin(), scene.schemes.end(), [&](const SchemeSpec& s) {
        return s.isEnabled && s.composition.type.empty() &&
               (named.empty() ? s.baseline.type == baseline : s.named == named);
    });
}

/// Some discretizations have several names.
bool hasSame(const std::vector<ResolvedScheme>& schemes, const ResolvedScheme& candidate) {
    const Discretization* const own = candidate.plain();
    return own && std::any_of(schemes.begin(), schemes.end(), [&](const ResolvedScheme& s) {
               return s.spec.solver.keys.empty() && s.plain() && *s.plain() == *own;
           });
}

/// Its label, which no other scheme has.
std::string labelFor(const Scene& scene, const Value& candidate) {
    std::string label = textOf(candidate, "scheme") + textOf(candidate, "baseline");
    const auto isTaken = [&] {
        return std::any_of(scene.schemes.begin(), scene.schemes.end(),
                           [&](const SchemeSpec& s) { return s.label == label; });
    };
    while (isTaken()) label += " (as named)";
    return label;
}

std::string lacking(const CatalogItem& item, const System& system) {
    return item.needs.empty() ? "does not take " + system.id : "needs " + item.needs;
}

/// The scheme with its default keys. Throws InvalidScene where it does not take the system.
ResolvedScheme candidateOf(const Value& given, const std::string& label, const ResolvedScene& scene) {
    constexpr double steps = 100;  // a place to begin: a search has steps of its own
    const System& system = *scene.system;
    const auto refuse = [](const std::string& why) { throw InvalidScene("/schemes", why); };
    SchemeSpec spec;
    spec.label = label;
    spec.isEnabled = false;
    spec.solver.type = "auto";
    spec.step = {timeSpan(scene.scene).length() / steps, {}};
    if (const BaselineEntry* const baseline = findBaseline(textOf(given, "baseline"))) {
        if (!canIntegrate(*baseline, system)) refuse(lacking(baseline->item, system));
        spec.baseline.type = baseline->item.id;
        for (const FieldInfo& key : baseline->item.parameters) {
            if (key.fallback.isNull() && !key.isOptional) refuse("has no default for \"" + key.key + "\"");
            if (!key.fallback.isNull()) spec.baseline.keys.emplace_back(key.key, key.fallback);
        }
        spec.kind = SchemeSpec::Kind::baseline;
        if (baseline->isAdaptive()) {
            spec.tolerance = given.find("tolerance")->asNumber();
            spec.step = {};
        }
    } else {
        spec.kind = SchemeSpec::Kind::named;
        spec.named = textOf(given, "scheme");
        const auto discretization = namedScheme(spec.named);
        const Family* const family = discretization ? familyOf(discretization->space) : nullptr;
        if (family && !appliesTo(*family, system)) refuse(lacking(family->item, system));
    }
    return acceptedBy(scene, spec);
}

/// Compositions of what is symmetric and of order 2: of each order those that may be the cheapest. Those of
/// the scene are there already.
void addCompositions(Candidates& all) {
    constexpr std::pair<const char*, int> worthTrying[] = {
        {"yoshida", 4}, {"suzuki", 4}, {"kahan-li", 6}, {"kahan-li", 8}};
    const std::size_t plain = all.scene.schemes.size();
    for (std::size_t i = 0; i < plain; ++i) {
        const ResolvedScheme part = all.scene.schemes[i];
        // Low degrees with other rules are the same scheme, or explicit ones that are there as baselines.
        if (part.family && part.discretization.quadrature.type != "gauss") continue;
        if (part.isComposed() || !part.isFixed() || !part.claims.isSymmetric || part.claims.order != 2 ||
            hasStepOfItsSpace(all.scene, part))
            continue;
        for (const auto& [type, order] : worthTrying) {
            SchemeSpec spec = part.spec;
            spec.composition = {type, {{"order", static_cast<double>(order)}}, {}};
            spec.isEnabled = false;
            const bool isThere = std::any_of(
                all.scene.scene.schemes.begin(), all.scene.scene.schemes.end(), [&](const SchemeSpec& s) {
                    return s.composition == spec.composition && s.named == spec.named &&
                           s.baseline == spec.baseline && s.space == spec.space;
                });
            std::string hint;
            if (isThere || !compositionRefusal(spec.composition, part.claims, hint).empty()) continue;
            spec.label += std::string(", ") + type + " " + std::to_string(order);
            try {
                ResolvedScheme candidate = acceptedBy(all.scene, spec);
                all.scene.scene.schemes.push_back(candidate.spec);
                all.scene.schemes.push_back(std::move(candidate));
            } catch (const InvalidScene& e) {
                all.refused.push_back({spec.label, e.problems().front().message});
            }
        }
    }
}

}  // namespace

ResolvedScheme acceptedBy(const ResolvedScene& scene, const SchemeSpec& spec) {
    const System& system = *scene.system;
    const auto refuse = [](const std::string& why) { throw InvalidScene("/schemes", why); };
    ResolvedScheme scheme = resolve(spec, &system);
    if (!scheme.fits(system)) refuse("does not take " + system.id);
    if (!scheme.properties.refusal.empty()) refuse(scheme.properties.refusal);
    if (!scheme.properties.instability.empty()) refuse(scheme.properties.instability);
    if (const auto* const own = scheme.family ? scheme.family->parts.find<StepOfSpace>() : nullptr) {
        const auto parameter = [&](std::string_view name) {
            return std::optional(scene.scene.model.number(name));
        };
        const auto implied = own->implied(scheme.discretization.space, scene.scene.model, parameter);
        if (implied && !(implied->step > 0)) refuse("has no step on " + system.id);
        if (implied) scheme.spec.step = {implied->step, {}};
    }
    resolveSystem(scheme, scene.scene);
    return scheme;
}

std::vector<Value> everyScheme(const std::set<int>& degrees) {
    std::vector<Value> all;
    for (const SchemeEntry& entry : schemeCatalog())
        for (int degree = entry.minDegree; degree <= entry.maxDegree; ++degree) {
            if (entry.maxDegree > 0 && !degrees.contains(degree)) continue;
            std::string id = entry.item.id;
            if (const auto at = id.find('<'); at != std::string::npos)
                id = id.substr(0, at) + std::to_string(degree);
            all.push_back(Value::Object{{"label", id}, {"scheme", id}});
        }
    for (const BaselineEntry& entry : baselineCatalog()) {
        Value scheme(Value::Object{{"label", entry.item.title}, {"baseline", entry.item.id}});
        if (entry.isAdaptive()) scheme.set("tolerance", 1e-6);
        all.push_back(std::move(scheme));
    }
    return all;
}

Candidates candidatesFor(const ResolvedScene& scene) {
    Candidates all{scene, scene.schemes.size(), {}};
    for (const Value& given : everyScheme({1, 2, 3, 4, 5, 6, 7, 8})) {
        if (hasScheme(scene.scene, given)) continue;
        const std::string label = labelFor(scene.scene, given);
        try {
            ResolvedScheme candidate = candidateOf(given, label, scene);
            if (hasSame(all.scene.schemes, candidate)) continue;
            all.scene.scene.schemes.push_back(candidate.spec);
            all.scene.schemes.push_back(std::move(candidate));
        } catch (const InvalidScene& e) {
            all.refused.push_back({label, e.problems().front().message});
        }
    }
    addCompositions(all);
    return all;
}

}  // namespace extremal
