// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/companion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/composition.hpp"

namespace extremal {
namespace {

constexpr double leastTolerance = 1e-14;  ///< of a companion: below it there is round-off alone
constexpr const char* remedy = "use \"auto\" as the reference";

[[noreturn]] void refuse(const std::string& what) {
    throw InvalidScene("", "has no companion with one degree more: " + what, remedy);
}

Value* keyOf(Settings& settings, std::string_view key) {
    for (auto& [name, value] : settings.keys)
        if (name == key) return &value;
    return nullptr;
}

/// One more, within the range of the catalogue.
void raise(Value& value, const CatalogItem& item, std::string_view key) {
    if (!value.isNumber()) refuse("its " + std::string(key) + " is not a number");
    const double raised = value.asNumber() + 1;
    for (const FieldInfo& field : item.parameters)
        if (field.key == key && raised > field.max)
            refuse("the " + std::string(key) + " of " + item.id + " is at most " + formatNumber(field.max));
    value = raised;
}

SchemeSpec ofFamily(const ResolvedScheme& scheme) {
    SchemeSpec spec = scheme.spec;
    spec.kind = SchemeSpec::Kind::discretization;
    spec.named.clear();
    spec.space = scheme.discretization.space;
    spec.quadrature = scheme.discretization.quadrature;
    spec.solver = scheme.discretization.solver;
    Value* degree = keyOf(spec.space, "degree");
    if (!degree) refuse("the space " + spec.space.type + " has no degree");
    for (const SpaceEntry& entry : scheme.family->spaces)
        if (entry.item.id == spec.space.type) raise(*degree, entry.item, "degree");
    if (Value* nodes = keyOf(spec.quadrature, "nodes"); nodes && nodes->isNumber())
        *nodes = nodes->asNumber() + 1;
    else
        spec.quadrature = {};  // of one degree only, as the midpoint rule: what is usual for the degree
    return spec;
}

SchemeSpec halved(const ResolvedScheme& scheme) {
    SchemeSpec spec = scheme.spec;
    spec.step.value /= 2;
    return spec;
}

SchemeSpec ofBaseline(const ResolvedScheme& scheme, const System& system) {
    SchemeSpec spec = scheme.spec;
    const int order = scheme.claims.order;
    if (scheme.isAdaptive()) {
        spec.tolerance = std::max(leastTolerance, spec.tolerance.value_or(1e-6) / 100);
        if (!(*spec.tolerance < scheme.spec.tolerance)) refuse("its tolerance is at round-off");
        return spec;
    }
    if (Value* stages = keyOf(spec.baseline, "stages")) {
        raise(*stages, scheme.baseline->item, "stages");
        return spec;
    }
    if (scheme.claims.isSymmetric && order > 2) return halved(scheme);
    std::string hint;
    const Claims own = claimsOf(*scheme.baseline, spec.baseline, &system);
    const Settings composition{"yoshida", {{"order", static_cast<double>(order + 2)}}, {}};
    if (compositionRefusal(composition, own, hint).empty()) {
        spec.composition = composition;
        return spec;
    }
    constexpr const char* collocation = "gauss-collocation";
    if (!appliesTo(*findBaseline(collocation), system))
        refuse(spec.baseline.type + " is not symmetric, and cannot be composed");
    const int stages = std::max(2, order);
    spec.baseline = {collocation, {{"stages", static_cast<double>(stages)}}, {}};
    return spec;
}

}  // namespace

ResolvedScheme companionOf(const ResolvedScheme& scheme, const System& system) {
    const int inSpace = scheme.orderInSpace();
    if (inSpace > 0 || system.error.ofFunction)
        refuse("its error in space is that of the mesh, which both would share");
    const SchemeSpec spec = scheme.isComposed() ? halved(scheme)
                            : scheme.family     ? ofFamily(scheme)
                                                : ofBaseline(scheme, system);
    ResolvedScheme companion = resolve(spec, &system);
    companion.spec.label = "companion of " + scheme.spec.label;
    if (!companion.properties.refusal.empty()) refuse(companion.properties.refusal);
    if (!companion.fits(system)) refuse("the higher degree does not fit " + system.id);
    return companion;
}

std::optional<ResolvedScheme> secondCompanionOf(const ResolvedScheme& scheme, const ResolvedScheme& first) {
    ResolvedScheme second = scheme;
    if (scheme.isAdaptive()) {
        const double own = *scheme.spec.tolerance, its = *first.spec.tolerance;
        second.spec.tolerance =
            its > 2 * leastTolerance ? std::max(leastTolerance, its / 10) : std::sqrt(own * its);
        second.spec.label = "second companion of " + scheme.spec.label;
        return second;
    }
    if (!scheme.isFixed() && !scheme.isMonitored()) return {};
    const bool isHalved = first.spec.step.value < scheme.spec.step.value;
    second.spec.step.value /= isHalved ? 3 : 2;
    second.spec.label = "second companion of " + scheme.spec.label;
    return second;
}

double unresolvedTurn(const ResolvedScheme& scheme, const System& system, const State& initial) {
    if (!system.hasCoordinates() || scheme.isAdaptive() || scheme.isMonitored()) return 0;
    const double longest = system.fast.frequency > 0 ? 0.5 : 2;
    const double turned = highestFrequency(system, initial) * scheme.spec.step.value;
    return turned > longest ? turned : 0;
}

}  // namespace extremal
