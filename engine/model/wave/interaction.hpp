// SPDX-License-Identifier: GPL-3.0-or-later
/// The interaction of a wave function with itself, that of Gross and Pitaevskii:
///
///     i hbar psi_t = H psi + g |psi|^2 psi.
/// It comes from the action with -g |psi|^4 / 2 in the Lagrangian; norm and energy are conserved, where V
/// does not depend on time. A part that binds: schemes for linear equations do not take it.
#pragma once

#include <memory>

#include "engine/model/parts.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/rotation.hpp"

namespace extremal {

struct Interaction {
    static constexpr PartInfo part{"interaction", "a wave function with an interaction g |ψ|²"};
    double g = 0;
};

/// The integral of |psi|^4 over the domain, of a periodic one.
double quarticIntegral(const Hamiltonian& h, const Complex* c);

/// What acts on a wave function besides H.
struct Coupling {
    double g = 0, omega = 0;
    bool isThere() const { return g != 0 || omega != 0; }
};
/// That of the parts Interaction and Rotation.
Coupling couplingOf(const Parts& parts);
/// Whether one of them is there, whatever its number.
bool isCoupled(const Parts& parts);

/// (<H> - Omega <L> + g/2 integral |psi|^4) / <1>, conserved by the motion.
double coupledEnergy(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling, double t,
                     const Complex* c);
/// (<H> - Omega <L> + g integral |psi|^4) / <1>: the chemical potential, hbar times the rate of the phase at
/// rest.
double chemicalPotential(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling, double t,
                         const Complex* c);

}  // namespace extremal
