// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines by name: what users would otherwise use, to compare with.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct Tableau;

struct BaselineOptions {
    double step = 0;       ///< fixed-step schemes
    State start = {};      ///< of the run; x is empty where it is not known
    double tolerance = 0;  ///< adaptive schemes
    Settings settings;     ///< the baseline's own keys
};

struct BaselineEntry {
    CatalogItem item;
    bool isAdaptive = false;  ///< takes "tolerance" instead of "step"
    /// Of those that are not adaptive. free: "step" is the first step.
    TimeGrid grid = TimeGrid::fixed;
    Takes takes = Takes::only<Mechanical>();        ///< the binding parts that its steps understand
    std::function<bool(const System&)> suits;       ///< of systems of these parts; empty: all do
    std::function<Claims(const Settings&)> claims;  ///< where they depend on its keys; else item.claims
    std::function<Claims(const System&)> claimsOn;  ///< where they depend on the kind of system
    int orderInSpace = 0;  ///< of fields on meshes, which compositions in time do not raise; 0: there is none
    double stabilityLimit =
        0;  ///< largest step * frequency on the harmonic oscillator; infinity: none; 0: not fixed-step
    /// The step as a Runge-Kutta method, of its formula where steps are chosen by an error control. Throws
    /// InvalidScene (pointer relative to the scheme) where the keys make no such method. Empty: it is not
    /// one.
    std::function<std::shared_ptr<const Tableau>(const Settings&)> tableau;
    /// The same limit where it depends on its keys; empty: stabilityLimit.
    std::function<double(const Settings&)> stabilityLimitOf;
    /// What is wrong or doubtful in its keys, pointers relative to the scheme; null: nothing beyond their
    /// ranges.
    void (*examine)(const Settings&, Findings&) = nullptr;
    /// What stands against a step beyond the stability limit of the harmonic oscillator; null: nothing.
    void (*check)(const SchemeCase&, Findings&) = nullptr;
    /// Throws InvalidScene (pointer relative to the scheme) where it cannot.
    std::function<std::unique_ptr<Integrator>(const System&, const BaselineOptions&)> make;
};

/// Whether a baseline can integrate a system: it applies, and where few do, its maker does not refuse.
bool canIntegrate(const BaselineEntry& entry, const System& system);

/// The claims of a baseline with these keys; on a system, where it is known.
Claims claimsOf(const BaselineEntry& entry, const Settings& settings, const System* system = nullptr);

const std::vector<BaselineEntry>& baselineCatalog();
const BaselineEntry* findBaseline(std::string_view id);

}  // namespace extremal
