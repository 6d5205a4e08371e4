// SPDX-License-Identifier: GPL-3.0-or-later
/// exp(-i dt H/hbar) as a Chebyshev series over the whole spectrum of H, cut where its coefficients reach
/// round-off (Tal-Ezer and Kosloff, J. Chem. Phys. 81 (1984) 3967):
///     exp(-i dt H/hbar) = e^{-i dt Em/hbar} sum_k (2 - delta_k0) (-i)^k J_k(R) T_k((H - Em)/W),
/// Em and W the middle and half the width of the spectrum, R = dt W/hbar. About R + 30 products with H a
/// step, however little of the spectrum the wave function uses. Not unitary, but its norm is off by no more
/// than its error.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// H must not depend on time.
std::unique_ptr<Integrator> makeChebyshevSeries(std::shared_ptr<const Hamiltonian> hamiltonian, double step);

}  // namespace extremal
