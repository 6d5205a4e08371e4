// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/cost_trial.hpp"

#include "engine/core/problem.hpp"
#include "engine/scene/outlook/cost.hpp"

namespace extremal {
namespace {

/// 0 where the scheme cannot be made or a trial step fails: the run will say why.
double secondsOf(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    try {
        return predictSeconds(scene, scheme);
    } catch (const InvalidScene&) {
        return 0;
    }
}

}  // namespace

TrialCosts tryCosts(const ResolvedScene& scene, const std::function<bool(const SchemeSpec&)>& isWanted,
                    const std::stop_token& stop) {
    TrialCosts costs;
    for (const ResolvedScheme& scheme : scene.schemes) {
        if (stop.stop_requested()) return costs;
        if (!scheme.spec.isEnabled || !isWanted(scheme.spec)) continue;
        if (const double seconds = secondsOf(scene, scheme); seconds > 0)
            costs.seconds.emplace_back(scheme.spec, seconds);
    }
    for (const ResolvedScheme& scheme : scene.reference)
        if (!stop.stop_requested()) costs.reference += secondsOf(scene, scheme);
    return costs;
}

}  // namespace extremal
