// SPDX-License-Identifier: GPL-3.0-or-later
/// The state of least energy of a wave function with an interaction,
///
///     E(psi) = <H> + g/2 integral |psi|^4,  integral |psi|^2 = 1,   (H + g |psi|^2) psi = mu psi,
/// and its approximation without kinetic energy, that of Thomas and Fermi: g |psi|^2 = max(0, mu - V).
///
/// psi is real. First E goes down along the sphere by nonlinear conjugate gradients, with the
/// preconditioner W^{-1/2} (T + a)^{-1} W^{-1/2}, W = a + V - min V + max(0, g) psi^2 at the nodes, a the
/// energy above min V (Antoine, Levitt and Tang 2017, J. Comput. Phys. 343, 92); then Newton's method with
/// the multiplier mu (stationary.hpp) takes the rest.
#pragma once

#include "engine/model/wave/start/stationary.hpp"

namespace extremal {

/// Of a split H that does not depend on time; its energy is mu. With attraction from a packet at the least V
/// next to the middle: a minimum, which need not be the only one. Not converged where the energy has no
/// minimum, or Newton's method leads to another state.
StationaryState groundState(const Hamiltonian& h, double g);

struct ThomasFermi {
    double mu = 0;                ///< the chemical potential
    std::vector<double> density;  ///< |psi|^2 at the nodes, its integral is 1
};
/// With repulsion, g > 0. mu is exact on the grid: the integral is the sum over its nodes.
ThomasFermi thomasFermi(const Hamiltonian& h, double g);

}  // namespace extremal
