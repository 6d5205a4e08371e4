/// The norm of a wave function, sqrt(h sum |psi_j|^2), and its change: kept by every unitary scheme.
#include <cmath>

#include "engine/observe/catalog.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal::observables {

ObservableEntry norm() {
    ObservableEntry e;
    e.item = {"norm", "norm", "Norm of the wave function, and its change.", {}, {}, "a wave function"};
    e.applies = [](const System& system) { return system.hasWave(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"norm", "‖ψ‖", "", {}, {}}, {"norm_error", "‖ψ‖ - ‖ψ(0)‖", "", {}, {}}};
        o.extreme = 1;
        const int n = context.system.wave->size();
        const double start = std::sqrt(squaredNorm(coefficients(context.initial.x.data()), n));
        o.evaluate = [n, start](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = std::sqrt(squaredNorm(coefficients(nodes.x(i)), n));
                values[1] = values[0] - start;
            }
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
