/// The virial q . p. Its mean over a bounded motion tends to a constant, and its rate of change to 0.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry virial() {
    ObservableEntry e;
    e.item = {"virial", "virial", "The scalar product of q and p.", {}, {}, ""};
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"virial", "q·p", "", {}}};  // name in files, symbol in plots, unit
        o.evaluate = [d = static_cast<std::size_t>(context.system.dimension())](const State& state, const StepReport&,
                                                                                double* values) {
            values[0] = 0;
            for (std::size_t i = 0; i < d; ++i) values[0] += state.x[i] * state.x[d + i];
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
