// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/equations.hpp"

#include <algorithm>

#include "engine/family/step_equations.hpp"
#include "engine/scene/view_choices.hpp"

namespace extremal {

std::shared_ptr<ExactActions> exactActionsOf(const ResolvedScene& scene, const ProductPlan& plan) {
    if (!plan.has(Product::actionDefect) || !localCoordinates(*scene.system, scene.initial)) return nullptr;
    double largest = 0;
    for (const ResolvedScheme& s : scene.schemes)
        if (s.spec.isEnabled && s.plain()) largest = std::max(largest, 2 * s.spec.step.value);
    return largest > 0 ? std::make_shared<ExactActions>(*scene.system, scene.initial, largest) : nullptr;
}

void addEquations(SchemeResult& result, const ProductPlan& plan, const ResolvedScene& scene,
                  const ResolvedScheme& scheme, const State& start, ExactActions* exact,
                  const std::stop_token& stop) {
    const System& system = *systemOf(scene, scheme);
    const Discretization* const plain = scheme.plain();
    const auto failureOf = [&](const char* view) { return unsuitableFor(*findView(view), scheme); };
    if (plan.has(Product::kktPattern)) {
        KktPattern& pattern = result.products.make<KktPattern>();
        pattern.failure = failureOf("sparsity");
        if (pattern.failure.empty()) pattern = kktPattern(system, *plain, start, scheme.spec.step.value);
    }
    if (plan.has(Product::actionDefect)) {
        ActionDefect& defect = result.products.make<ActionDefect>();
        defect.failure = failureOf("discrete-lagrangian");
        if (!defect.failure.empty()) return;
        const StepCase step{system, *plain, start, 2 * scheme.spec.step.value};
        if (exact)
            defect = actionDefect(system, *plain, start.t, *exact, stop);
        else
            defect = actionDefect(step, stop);
    }
}

}  // namespace extremal
