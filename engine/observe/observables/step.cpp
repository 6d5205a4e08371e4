// SPDX-License-Identifier: GPL-3.0-or-later
/// The time step that ended at this node, and how it ended: converged, or the event that it had besides
/// (core/outcome.hpp).
#include <limits>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry step() {
    ObservableEntry e;
    e.item = {"step", "step", "Size and outcome of the step that ended at each row.", {}, {}, ""};
    e.takes = Takes::everything();
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"step", "h", context.system.timeUnit, {}, {}}, {"outcome", "outcome", "", {}, {}}};
        // A node that was reached was reached by a converged step: what else the step did is its event.
        for (int i = 0; i < stepEventCount; ++i)
            o.columns[1].words.push_back(i == 0 ? "converged" : std::string(name(static_cast<StepEvent>(i))));
        o.evaluate = [](const State& state, const StepReport& report, double* values) {
            values[0] = state.node == 0 ? std::numeric_limits<double>::quiet_NaN() : report.step;
            values[1] = static_cast<double>(report.event);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
