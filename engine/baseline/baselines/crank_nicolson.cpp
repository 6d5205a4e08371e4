// SPDX-License-Identifier: GPL-3.0-or-later
/// The Crank-Nicolson scheme for wave functions, (1 + i dt H/2 hbar) psi_1 = (1 - i dt H/2 hbar) psi_0: what
/// most use, with energies counted as they stand. It is the Gauss scheme of degree 1 without an energy shift.
#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/wave/wave.hpp"

namespace extremal::baselines {

BaselineEntry crank_nicolson() {
    BaselineEntry e;
    e.item = {"crank-nicolson",
              "Crank-Nicolson",
              "The implicit midpoint rule for wave functions: order 2, unitary; one solve per step.",
              {},
              Claims{2, true, true, {"norm", "energy"}},
              "a wave function"};
    e.takes = Takes::only<Wave>();
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeGaussWave(system, 1, 0, options.step);
    };
    return e;
}

}  // namespace extremal::baselines
