// SPDX-License-Identifier: GPL-3.0-or-later
/// RK4 on differentiated constraints with a feedback: |g| stays bounded and is not 0, the energy drifts.
#include "engine/baseline/kutta_on_constraints.hpp"
#include "engine/baseline/parts.hpp"

namespace extremal::baselines {

BaselineEntry baumgarte() {
    BaselineEntry e;
    e.item = {
        "baumgarte",
        "Baumgarte (RK4)",
        "RK4 on constraints differentiated twice, with a feedback that pulls back: near the constraint and "
        "not on it; the energy drifts.",
        {positive("alpha", "feedback", "", 20,
                  "Of g'' + 2 alpha g' + alpha^2 g = 0; h alpha is to stay below 1.")},
        Claims{4, false, false, {}},
        "constraints"};
    e.takes = constrainedProblems();
    e.parts.set(needsConstraints());
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        const double alpha = options.settings.number("alpha");
        return std::make_unique<KuttaOnConstraints>(system, options,
                                                    KuttaOnConstraints::Remedy{alpha, false});
    };
    return e;
}

}  // namespace extremal::baselines
