// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/catalog.hpp"

#include <algorithm>

#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/wave/wave.hpp"

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

bool canIntegrate(const BaselineEntry& entry, const System& system) {
    if (!appliesTo(entry, system)) return false;
    // Where H is a full matrix there are few ways, and their makers know; a trial costs little with at most
    // 512 modes.
    if (!system.parts.find<Wave>() || !hasFullMatrix(system)) return true;
    Settings settings{entry.item.id, {}, {}};
    for (const FieldInfo& f : entry.item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    try {
        BaselineOptions options;
        options.step = 1e-9;
        options.settings = settings;
        (void)entry.make(system, options);
    } catch (const InvalidScene&) {
        return false;
    }
    return true;
}

Claims claimsOf(const BaselineEntry& entry, const Settings& settings, const System* system) {
    if (const auto* const onSystem = entry.parts.find<ClaimsOnSystem>(); system && onSystem)
        return onSystem->of(*system);
    const auto* const ofKeys = entry.parts.find<ClaimsOfKeys>();
    return ofKeys ? ofKeys->of(settings) : entry.item.claims.value_or(Claims{});
}

}  // namespace extremal
