// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run carries along for its observables.
#pragma once

#include <string>
#include <vector>

#include "engine/integrator/variation/with_variations.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal {

/// Which variations of the state the observables need.
inline VariationPlan variationsFor(const std::vector<std::string>& observe) {
    VariationPlan plan;
    for (const std::string& id : observe)
        if (const ObservableEntry* entry = findObservable(id)) {
            plan.map = plan.map || entry->variations.map;
            plan.vector = plan.vector || entry->variations.vector;
            plan.frame = plan.frame || entry->variations.frame;
            plan.errors = plan.errors || entry->variations.errors;
            plan.parameters = plan.parameters || entry->variations.parameters;
        }
    return plan;
}

}  // namespace extremal
