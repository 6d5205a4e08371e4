// SPDX-License-Identifier: GPL-3.0-or-later
/// Spectral collocation in time, for wave functions: a polynomial of degree s through the start that
/// satisfies the equation at Chebyshev nodes of the step, s of them: the extrema without the start, or the
/// roots. Not from an action: at the extrema the norm is off by about the square of the error; the roots are
/// symmetric, which keeps it.
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/family/wave/wave_collocation.hpp"

namespace extremal::baselines {
namespace {

Rule<double> nodesOf(int s, bool isExtrema) {
    Rule<double> rule;
    for (int j = 1; j <= s; ++j) {
        const double angle = std::numbers::pi * (isExtrema ? static_cast<double>(j) / s : (j - 0.5) / s);
        rule.c.push_back(0.5 * (1 - std::cos(angle)));
        rule.b.push_back(1.0 / s);  // not used
    }
    rule.isSymmetric = !isExtrema;
    return rule;
}

}  // namespace

BaselineEntry spectral_collocation() {
    const FieldInfo degree =
        integerField("degree", "s", 1, 64, 8, "Degree of the polynomial in time on one step.");
    const FieldInfo nodes =
        choiceField("nodes", "nodes", {"extrema", "roots"},
                    "Chebyshev extrema without the start of the step, or Chebyshev roots.");
    BaselineEntry e;
    e.item = {"spectral-collocation",
              "spectral collocation",
              "Wave functions by collocation in time at Chebyshev nodes: spectral, but from no action.",
              {degree, nodes},
              Claims{8, false, false, {}},
              "a wave function"};
    e.takes = Takes::only<Wave>();
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        const int s = settings.integer("degree");
        // Collocation has the order of its interpolatory rule.
        return settings.text("nodes") == "roots" ? collocationClaims(s) : Claims{s, false, false, {}};
    }});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        requireSplit(system, "/baseline", "spectral-collocation",
                     "schrodinger-gauss-8, crank-nicolson or chebyshev-propagation");
        return makeCollocationWave(
            system.hamiltonian(), options.step, meanEnergy(*system.hamiltonian(), options.start),
            nodesOf(options.settings.integer("degree"), options.settings.text("nodes") != "roots"), 1e-13,
            600);
    };
    return e;
}

}  // namespace extremal::baselines
