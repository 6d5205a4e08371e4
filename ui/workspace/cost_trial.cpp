// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/cost_trial.hpp"

#include "engine/scene/outlook/cost.hpp"

namespace extremal {
TrialCosts tryCosts(const ResolvedScene& scene, const std::function<bool(const SchemeSpec&)>& isWanted,
                    const std::stop_token& stop) {
    TrialCosts costs;
    for (const ResolvedScheme& scheme : scene.schemes) {
        if (stop.stop_requested()) return costs;
        if (!scheme.spec.isEnabled || !isWanted(scheme.spec)) continue;
        if (const double seconds = trialSeconds(scene, scheme, stop); seconds > 0)
            costs.seconds.emplace_back(scheme.spec, seconds);
    }
    for (const ResolvedScheme& scheme : scene.reference)
        if (!stop.stop_requested()) costs.reference += trialSeconds(scene, scheme, stop);
    return costs;
}

}  // namespace extremal
