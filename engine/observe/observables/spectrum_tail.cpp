/// The share of the wave function in the upper eighth of its wave numbers: far above round-off, N is too
/// small.
#include "engine/observe/catalog.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal::observables {

ObservableEntry spectrum_tail() {
    ObservableEntry e;
    e.item = {"spectrum-tail",
              "spectrum tail",
              "Share of the wave function in the upper eighth of its modes: is N enough?",
              {},
              {},
              "a wave function"};
    e.applies = [](const System& system) { return system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"spectrum_tail", "tail", "", {}, {}}};
        o.evaluate = [h = context.system.wave](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                values[0] = spectrumTail(*h, coefficients(nodes.x(i)));
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
