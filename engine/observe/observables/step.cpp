/// The time step that ended at this node, and how it ended (0 = converged; the number of the Outcome else).
#include <limits>

#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry step() {
    ObservableEntry e;
    e.item = {"step", "step", "Size and outcome of the step that ended at each row.", {}, {}, ""};
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"step", "h", context.system.timeUnit, {}, {}}, {"outcome", "outcome", "", {}, {}}};
        // A node that was reached was reached by a converged step: the column is for readers of the file.
        for (int i = 0; i < outcomeCount; ++i)
            o.columns[1].words.push_back(i == 0 ? "converged" : std::string(name(static_cast<Outcome>(i))));
        o.evaluate = [](const State& state, const StepReport& report, double* values) {
            values[0] = state.node == 0 ? std::numeric_limits<double>::quiet_NaN() : report.step;
            values[1] = static_cast<double>(report.outcome);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
