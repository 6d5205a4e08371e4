// SPDX-License-Identifier: GPL-3.0-or-later
/// The virial q . p: the mean of its rate of change over a bounded motion tends to 0.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry virial() {
    ObservableEntry e;
    e.item = {"virial", "virial", "The scalar product of q and p, and its change.", {}, {}, ""};
    e.bind = [](const ObserveContext& context) {
        const auto d = static_cast<std::size_t>(context.system.dimension());
        const auto virial = [d](const double* x) {
            double sum = 0;
            for (std::size_t i = 0; i < d; ++i) sum += x[i] * x[d + i];
            return sum;
        };
        Observer o;
        // Name in files, symbol in plots, unit.
        o.columns = {{"virial", "q·p", "", {}}, {"virial_change", "q·p - (q·p)(0)", "", {}}};
        o.extreme = 1;  // the largest change over all nodes goes into the summary
        o.evaluate = [virial, start = virial(context.initial.x.data())](const State& state, const StepReport&,
                                                                        double* values) {
            values[0] = virial(state.x.data());
            values[1] = values[0] - start;
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
