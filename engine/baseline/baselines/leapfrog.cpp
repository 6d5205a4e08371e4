/// Leapfrog for wave functions, psi^{l+1} = psi^{l-1} - (2 i dt/hbar) H psi^l: explicit, stable for |E| dt <=
/// hbar. The three-level scheme of the trapezoidal rule, started with one step of Gauss degree 2.
#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/wave/wave_three_level.hpp"

namespace extremal::baselines {

BaselineEntry leapfrog() {
    BaselineEntry e;
    e.item = {"leapfrog",
              "leapfrog",
              "Three levels, explicit: one product with H a step; stable for |E| dt up to ħ.",
              {},
              Claims{2, true, true, {"bilinear form"}, false},
              "a wave function"};
    e.applies = [](const System& system) { return isWave(system); };
    e.stabilityLimit = 1;
    e.check = [](const SchemeCase& scheme, Findings& findings) {
        checkWaveLimit(1, waveFrequency(scheme.system, 0), scheme.step, scheme.allowsUnstable, findings);
    };
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        if (system.hamiltonian()->isTimeDependent())
            throw InvalidScene("/baseline", "leapfrog needs a potential that does not depend on t", "strang");
        requirePeriodic(system, "/baseline", "leapfrog",
                        "schrodinger-gauss-8, crank-nicolson or chebyshev-propagation");
        return makeThreeLevelWave(
            system.hamiltonian(), options.step, 0,
            {0, WaveStart::gauss, planWave(system, 2, {}, options.step).solver, 1e-14, 600});
    };
    return e;
}

}  // namespace extremal::baselines
