/// The probability current through the middle of the domain, j = (hbar/m) Im(conj(psi) psi_x): what passes a
/// barrier there in a unit of time. The sign is that of d/dt |psi|^2 + d/dx j = 0; the printed one is
/// opposite.
#include <vector>

#include "engine/observe/catalog.hpp"
#include "engine/model/wave/spectrum.hpp"

namespace extremal::observables {

ObservableEntry current() {
    ObservableEntry e;
    e.item = {
        "current", "current", "Probability current through the middle of the domain, counted to the right.",
        {},        {},        "a wave function"};
    e.applies = [](const System& system) { return system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"current", "j", "", {}, {}}};
        const auto n = static_cast<std::size_t>(context.system.wave->size());
        o.evaluate = [h = context.system.wave, work = std::vector<Complex>(n),
                      slope = std::vector<Complex>(n)](const NodeBlock& nodes, double* values,
                                                       std::size_t stride) mutable {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                values[0] = currentInTheMiddle(*h, coefficients(nodes.x(i)), work.data(), slope.data());
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
