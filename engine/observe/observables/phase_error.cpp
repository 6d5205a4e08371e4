/// The phase by which a wave function is ahead of the reference, arg <psi_ref, psi>, in (-pi, pi].
#include <complex>
#include <vector>

#include "engine/observe/catalog.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal::observables {

ObservableEntry phase_error() {
    ObservableEntry e;
    e.item = {"phase-error",
              "phase error",
              "Phase of the wave function against the reference.",
              {},
              {},
              "a wave function and a reference"};
    e.needsReference = true;
    e.applies = [](const System& system) { return system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"phase_error", "arg⟨ψ ref, ψ⟩", "rad", {}, {}}};
        const int n = context.system.wave->size();
        const auto width = static_cast<std::size_t>(2 * n);
        o.evaluate = [n, width, reference = context.reference, exact = std::vector<double>()](
                         const NodeBlock& nodes, double* values, std::size_t stride) mutable {
            exact.resize(width * nodes.size());
            reference(nodes.times(), exact.data(), width);
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                values[0] = std::arg(
                    innerProduct(coefficients(exact.data() + i * width), coefficients(nodes.x(i)), n));
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
