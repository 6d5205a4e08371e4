// SPDX-License-Identifier: GPL-3.0-or-later
/// Chebyshev propagation of wave functions (family/wave/chebyshev_series.hpp).
#include <cmath>
#include <limits>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/duration.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/family/wave/chebyshev_series.hpp"

namespace extremal::baselines {
namespace {

/// R = dt W/hbar, W half the width of the spectrum.
double productsOf(const Hamiltonian& h, double step) {
    return std::abs(step) * (h.highest() - h.lowest()) / (2 * h.hbar());
}

/// CPU seconds of a product with H, over at least a millisecond of them.
double secondsOfProduct(const Hamiltonian& h) {
    const auto size = static_cast<std::size_t>(h.size());
    std::vector<Complex> v(size, Complex(1)), Hv(size), work(size);
    h.apply(h.potential().data(), v.data(), Hv.data(), work.data());  // meets its memory for the first time
    const double begin = threadSeconds();
    double spent = 0;
    int products = 0;
    while (spent < 1e-3 && products < 10000) {
        for (int i = 0; i < 10; ++i, ++products)
            h.apply(h.potential().data(), v.data(), Hv.data(), work.data());
        spent = threadSeconds() - begin;
    }
    return spent / products;
}

/// Between walls the width of the spectrum grows with the fourth power of the modes: a single step may take
/// minutes, which no trial of steps would find out in time.
void warnOfDuration(const SchemeCase& scheme, Findings& findings) {
    const Hamiltonian& h = *scheme.system.hamiltonian();
    const double steps = std::abs(scheme.end - scheme.initial.t) / scheme.step;
    const double products = productsOf(h, scheme.step) + 30;
    const double seconds = steps * products * secondsOfProduct(h);
    if (seconds > longWithoutWarning)
        findings.warning("",
                         "will take about " + durationText(seconds) + " of computing: " +
                             formatCount(std::round(products)) + " products with H for each step",
                         "fewer modes, or schrodinger-gauss-8, which does not depend on the highest energies",
                         {}, "duration");
}

}  // namespace

BaselineEntry chebyshev_propagation() {
    BaselineEntry e;
    e.item = {"chebyshev-propagation",
              "Chebyshev propagation",
              "The exponential of H as a Chebyshev series over its whole spectrum, to round-off at any step.",
              {},
              Claims{0, true, true, {"norm", "energy"}},
              "a wave function"};
    e.takes = Takes::only<Wave>();
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(StepCheck{warnOfDuration});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        if (system.hamiltonian()->isTimeDependent())
            throw InvalidScene("/baseline",
                               "chebyshev-propagation needs a potential that does not depend on t", "strang");
        const double R = productsOf(*system.hamiltonian(), options.step);
        if (R > 1e6)
            throw InvalidScene(
                "/step", "needs " + formatNumber(R, 2) + " products with H for each step, the limit is 1e6",
                "a smaller step, or fewer modes");
        return makeChebyshevSeries(system.hamiltonian(), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
