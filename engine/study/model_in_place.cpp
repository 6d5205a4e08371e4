// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/model_in_place.hpp"

#include <algorithm>

#include "engine/family/parts/model_in_place.hpp"

namespace extremal {

std::string modelInPlace(const ResolvedScheme& scheme, const System& system) {
    if (const BaselineEntry* const baseline = scheme.baseline) {
        const bool isReduced = std::any_of(system.reduced.begin(), system.reduced.end(),
                                           [&](const auto& r) { return r.id == baseline->item.id; });
        return isReduced ? baseline->item.title : std::string();
    }
    const auto* const model = scheme.family ? scheme.family->parts.find<ModelInPlace>() : nullptr;
    return model ? model->title(scheme.discretization, system) : std::string();
}

std::string modelInPlace(const ResolvedScene& scene, std::size_t scheme) {
    const std::string model = modelInPlace(scene.schemes[scheme], *scene.system);
    return model.empty() ? model : model + " in place of " + scene.system->id;
}

}  // namespace extremal
