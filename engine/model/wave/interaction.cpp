// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/interaction.hpp"

#include <complex>
#include <vector>

namespace extremal {

double quarticIntegral(const Hamiltonian& h, const Complex* c) {
    std::vector<Complex> psi(static_cast<std::size_t>(h.size()));
    h.toNodes(c, psi.data());
    double sum = 0;
    for (const Complex& each : psi) sum += std::norm(each) * std::norm(each);
    return sum * h.grid().measure() / h.size();
}

Coupling couplingOf(const Parts& parts) {
    const auto* const interaction = parts.find<Interaction>();
    const auto* const rotation = parts.find<Rotation>();
    return {interaction ? interaction->g : 0, rotation ? rotation->omega : 0};
}

bool isCoupled(const Parts& parts) { return parts.find<Interaction>() || parts.find<Rotation>(); }

namespace {

double energyWith(double quartic, const std::shared_ptr<const Hamiltonian>& h, Coupling coupling, double t,
                  const Complex* c) {
    double energy = h->energy(t, c);
    if (coupling.g != 0) energy += quartic * quarticIntegral(*h, c) / squaredNorm(c, h->size());
    if (coupling.omega != 0) energy -= coupling.omega * AngularMomentum(h).mean(c);
    return energy;
}

}  // namespace

double coupledEnergy(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling, double t,
                     const Complex* c) {
    return energyWith(coupling.g / 2, h, coupling, t, c);
}

double chemicalPotential(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling, double t,
                         const Complex* c) {
    return energyWith(coupling.g, h, coupling, t, c);
}

}  // namespace extremal
