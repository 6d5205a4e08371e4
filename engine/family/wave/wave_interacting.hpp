// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss(s) for wave functions with an interaction or in a rotating frame, i hbar psi_t = H psi + g |psi|^2
/// psi - Omega L psi: continuous polynomials of degree s in time, tested with degree s - 1, at the nodes of
/// Gauss. In the gauge Ec
///
///     Psi_i = v - i h/hbar sum_j A_ij ((T + w) Psi_j + R_j),   R = (V - Ec - w + g |psi|^2 - Omega L) psi,
///     v+    = v - i h/hbar sum_j b_j ((T + w) Psi_j + R_j),
/// mode by mode (1 + i h/hbar (T + w) A)^-1, inverted once, and a fixed point for R, which starts from that
/// of the last step. w changes nothing in the equations: it is the middle of V - Ec where h max |V - Ec|/hbar
/// is more than 2, and 0 elsewhere, where the iteration is faster without it. Order 2s; the norm is conserved
/// to the tolerance, as every quadratic invariant is, the energy bounded.
///
/// With InTime::exact the integral over time of |psi|^4 is exact in place of that rule: R_j is the projection
/// of R on polynomials of degree s - 1, by Gauss with 2s nodes. Order 2s, energy to the tolerance, norm
/// bounded; it is no stationary point of a sum, and not symplectic (continuous Petrov-Galerkin; Akrivis,
/// Dougalis and Karakashian 1991).
#pragma once

#include <memory>

#include "engine/model/wave/interaction.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {

enum class InTime { gauss, exact };

/// `shift`: Ec, or NaN for the chemical potential of the first state that is seen. tolerance 0: to round-off.
/// V does not depend on time, and the domain is periodic.
std::unique_ptr<WaveStep> makeInteractingWave(std::shared_ptr<const Hamiltonian> hamiltonian,
                                              Coupling coupling, double step, double shift, int degree,
                                              double tolerance, int maxIterations,
                                              InTime inTime = InTime::gauss);

}  // namespace extremal
