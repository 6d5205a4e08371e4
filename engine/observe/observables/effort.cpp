// SPDX-License-Identifier: GPL-3.0-or-later
/// What the step that ended at this node cost: iterations of its solver and evaluations of the Lagrangian or
/// force.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry effort() {
    ObservableEntry e;
    e.item = {
        "effort", "solver effort", "Iterations and evaluations of the step that ended at each row.", {}, {},
        ""};
    e.takes = Takes::everything();
    e.bind = [](const ObserveContext&) {
        Observer o;
        o.columns = {{"newton_iterations", "iterations", "", {}, {}},
                     {"evaluations", "evaluations", "", {}, {}}};
        o.evaluate = [](const State&, const StepReport& report, double* values) {
            values[0] = static_cast<double>(report.cost.iterations);
            values[1] = static_cast<double>(report.cost.evaluations);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
