// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/catalog.hpp"

#include <algorithm>

#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/group/group_flow.hpp"

namespace extremal {

const BaselineEntry* findBaseline(std::string_view id) {
    const auto& all = baselineCatalog();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const BaselineEntry& e) { return e.item.id == id; });
    return found == all.end() ? nullptr : &*found;
}

bool appliesTo(const BaselineEntry& entry, const System& system) {
    return isTaken(entry.takes, system.parts) && meetsCondition(entry.parts, system);
}

namespace {

Settings defaultsOf(const CatalogItem& item) {
    Settings settings{item.id, {}, {}};
    for (const FieldInfo& f : item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    return settings;
}

/// "the spaces tent and moving-mesh"
std::string named(const std::string& kind, const std::vector<std::string>& ids) {
    return "the " + kind + (ids.size() > 1 ? "s " : " ") + joinNames(ids);
}

}  // namespace

bool canIntegrate(const BaselineEntry& entry, const System& system) {
    if (!appliesTo(entry, system)) return false;
    // Where H is a full matrix there are few ways, and their makers know; a trial costs little with at most
    // 512 modes.
    if (!system.parts.find<Wave>() || !hasFullMatrix(system)) return true;
    try {
        BaselineOptions options;
        options.step = 1e-9;
        options.settings = defaultsOf(entry.item);
        (void)entry.make(system, options);
    } catch (const InvalidScene&) {
        return false;
    }
    return true;
}

Claims claimsOf(const BaselineEntry& entry, const Settings& settings, const System* system) {
    if (const auto* const onSystem = entry.parts.find<ClaimsOnSystem>(); system && onSystem)
        return onSystem->of(*system);
    const auto* const asEquations = entry.parts.find<ClaimsWithoutCoordinates>();
    if (asEquations && system && (isFirstOrder(*system) || isOnGroup(*system)))
        return asEquations->of(settings);
    const auto* const ofKeys = entry.parts.find<ClaimsOfKeys>();
    Claims claims = ofKeys ? ofKeys->of(settings) : entry.item.claims.value_or(Claims{});
    if (system) spins::claimLengths(*system, claims);
    return claims;
}

std::vector<const BaselineEntry*> baselinesFor(const System& system) {
    std::vector<const BaselineEntry*> entries;
    for (const BaselineEntry& entry : baselineCatalog())
        if (canIntegrate(entry, system)) entries.push_back(&entry);
    return entries;
}

std::string schemesFor(const System& system) {
    std::vector<std::string> spaces, baselines, kinds;
    for (const CatalogItem& item : spacesFor(system))
        if (isFor({defaultsOf(item), {}, {}}, system)) spaces.push_back(item.id);
    for (const BaselineEntry* entry : baselinesFor(system)) baselines.push_back(entry->item.id);
    if (!spaces.empty()) kinds.push_back(named("space", spaces));
    if (!baselines.empty()) kinds.push_back(named("baseline", baselines));
    if (kinds.empty()) return "no scheme takes it";
    return "it has " + kinds.front() + (kinds.size() > 1 ? ", and " + kinds.back() : "");
}

}  // namespace extremal
