// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines by name: what users would otherwise use, to compare with.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct BaselineOptions {
    double step = 0;       ///< fixed-step schemes
    State start = {};      ///< of the run; x is empty where it is not known
    double tolerance = 0;  ///< adaptive schemes
    Settings settings;     ///< the baseline's own keys
};

/// What every baseline says; what only some have are parts (engine/baseline/parts.hpp).
struct BaselineEntry {
    CatalogItem item;
    /// landing: it takes "tolerance" instead of "step". free: "step" is its first step.
    TimeGrid grid = TimeGrid::fixed;
    Takes takes = Takes::only<Mechanical>();  ///< the binding parts that its steps understand
    /// Throws InvalidScene (pointer relative to the scheme) where it cannot.
    std::function<std::unique_ptr<Integrator>(const System&, const BaselineOptions&)> make;
    Parts parts;

    bool isAdaptive() const { return grid == TimeGrid::landing; }
};

/// Whether it takes every part that the system needs, and the system meets its condition.
bool appliesTo(const BaselineEntry& entry, const System& system);
/// Whether a baseline can integrate a system: it applies, and where few do, its maker does not refuse.
bool canIntegrate(const BaselineEntry& entry, const System& system);

/// The claims of a baseline with these keys; on a system, where it is known.
Claims claimsOf(const BaselineEntry& entry, const Settings& settings, const System* system = nullptr);

const std::vector<BaselineEntry>& baselineCatalog();
const BaselineEntry* findBaseline(std::string_view id);
/// Those that can integrate a system.
std::vector<const BaselineEntry*> baselinesFor(const System& system);
/// What a user may take instead of a scheme that does not take a system: "it has the spaces .., and the
/// baselines ..", of those that take it with their default keys, or that there is nothing.
std::string schemesFor(const System& system);

}  // namespace extremal
