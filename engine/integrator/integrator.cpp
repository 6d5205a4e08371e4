// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/integrator.hpp"

namespace extremal {

StepReport Integrator::advanceBlock(State& state, NodeBlock& nodes, std::size_t count, const Clock& clock) {
    StepReport report;
    for (std::size_t i = 0; i < count && nodes.size() < nodes.capacity(); ++i) {
        report = advance(state, clock.at(state.node + 1));
        if (report.outcome != Outcome::converged) break;
        nodes.push(state, report);
        if (double* values = nodes.lastQuantities()) measure(state, values);
    }
    return report;
}

}  // namespace extremal
