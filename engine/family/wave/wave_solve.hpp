// SPDX-License-Identifier: GPL-3.0-or-later
/// One solve (zeta + i dt (H - Ec)/hbar) w = v of the two-step schemes, in any of the three ways.
/// Internal to engine/integrator.
#pragma once

#include <memory>
#include <stop_token>

#include "engine/core/outcome.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/solve/banded_poles.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// dt (H - Ec)/hbar in Fourier space, for a potential of few harmonics.
CyclicBand cyclicBand(const Hamiltonian& h, double dt, double shift);

class ShiftedInverse {
public:
    virtual ~ShiftedInverse() = default;
    /// In place; adds to the report. Allocates nothing.
    virtual Outcome apply(Complex* v, StepReport& report, const std::stop_token& stop) = 0;
};

std::unique_ptr<ShiftedInverse> makeShiftedInverse(WaveSolver solver,
                                                   const std::shared_ptr<const Hamiltonian>& hamiltonian,
                                                   double dt, double shift, Complex zeta, double tolerance,
                                                   int maxIterations);

}  // namespace extremal
