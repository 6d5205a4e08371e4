/// Chebyshev propagation of wave functions (family/wave/chebyshev_series.hpp).
#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/family/wave/chebyshev_series.hpp"

namespace extremal::baselines {
BaselineEntry chebyshev_propagation() {
    BaselineEntry e;
    e.item = {"chebyshev-propagation",
              "Chebyshev propagation",
              "The exponential of H as a Chebyshev series over its whole spectrum, to round-off at any step.",
              {},
              Claims{0, true, true, {"norm", "energy"}},
              "a wave function"};
    e.applies = [](const System& system) { return isWave(system); };
    e.stabilityLimit = std::numeric_limits<double>::infinity();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        if (system.hamiltonian()->isTimeDependent())
            throw InvalidScene("/baseline",
                               "chebyshev-propagation needs a potential that does not depend on t", "strang");
        const double R = options.step * (system.hamiltonian()->highest() - system.hamiltonian()->lowest()) /
                         (2 * system.hamiltonian()->hbar());
        if (R > 1e6)
            throw InvalidScene(
                "/step", "needs " + formatNumber(R, 2) + " products with H for each step, the limit is 1e6",
                "a smaller step, or fewer modes");
        return makeChebyshevSeries(system.hamiltonian(), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
