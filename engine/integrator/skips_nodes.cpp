// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/skips_nodes.hpp"

namespace extremal {

StepReport advanceOver(Integrator& integrator, State& state, long long count, const Clock& clock) {
    auto* const skipping = dynamic_cast<SkipsNodes*>(&integrator);
    return skipping ? skipping->advanceOver(state, count, clock)
                    : advanceByNodes(integrator, state, count, clock);
}

StepReport advanceByNodes(Integrator& integrator, State& state, long long count, const Clock& clock) {
    StepReport report;
    Cost cost;
    for (long long i = 0; i < count && report.outcome == Outcome::converged; ++i) {
        report = integrator.advance(state, clock.at(state.node + 1));
        cost += report.cost;
    }
    report.cost = cost;
    return report;
}

}  // namespace extremal
