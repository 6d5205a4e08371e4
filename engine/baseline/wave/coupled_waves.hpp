// SPDX-License-Identifier: GPL-3.0-or-later
/// What others use for i hbar psi_t = T psi + (V + g |psi|^2) psi on a Fourier grid, beside splittings.
///
/// Midpoint forms, with m = (psi + psi+)/2 and phi in place of |psi|^2:
///
///     i hbar (psi+ - psi)/h = (T + V(t + h/2) + g phi) m
///     besse                 phi_{n+1/2} = 2 |psi_n|^2 - phi_{n-1/2}, phi_{-1/2} = |psi_0|^2: linear in m;
///     norm delfour-fortin-payre  phi = (|psi|^2 + |psi+|^2)/2: norm and energy, not symplectic
/// of order 2 (Besse 2004; Delfour, Fortin and Payre 1981). m by a fixed point that is implicit in T and the
/// middle of V.
///
/// Exponential forms, with L = -i T/hbar and N = -i (V + g |psi|^2) psi/hbar: the classical method of order 4
/// on exp(-L t) psi (if-rk4), and that of Cox and Matthews 2002 (etd-rk4), whose functions of h L are
/// phi-functions here. Explicit, no norm, four times two transforms a step.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

enum class CoupledMidpoint { besse, delfourFortinPayre };
enum class ExponentialForm { integratingFactor, timeDifferencing };

/// H is split (Hamiltonian::isSplit).
std::unique_ptr<Integrator> makeCoupledMidpoint(std::shared_ptr<const Hamiltonian> h, double g, double step,
                                                CoupledMidpoint form);
std::unique_ptr<Integrator> makeExponentialWave(std::shared_ptr<const Hamiltonian> h, double g, double step,
                                                ExponentialForm form);

}  // namespace extremal
