/// The virial q . p: the mean of its rate of change over a bounded motion tends to 0.
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry virial() {
    ObservableEntry e;
    e.item = {"virial", "virial", "The scalar product of q and p.", {}, {}, ""};
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"virial", "q·p", "", {}}};  // name in files, symbol in plots, unit
        const auto d = static_cast<std::size_t>(context.system.dimension());
        o.evaluate = [d](const State& state, const StepReport&, double* values) {
            values[0] = 0;
            for (std::size_t i = 0; i < d; ++i) values[0] += state.x[i] * state.x[d + i];
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
