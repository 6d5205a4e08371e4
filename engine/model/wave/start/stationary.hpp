// SPDX-License-Identifier: GPL-3.0-or-later
/// The time-independent problem: stationary points of -c* H c - g/2 integral |psi|^4 + lambda (1 - c* c),
/// that is
///     (H + g |psi|^2) c = E c,  E = -lambda,  c* c = 1:
/// the multiplier of the norm is the energy, with an interaction the chemical potential (the printed
/// equations have -lambda v and lack the mass).
///
/// Newton's method on the KKT system, whose interaction asks for a psi that is real at the nodes,
///     [ H + 3 g psi^2 - E   -c ] [dc]   [ -((H + g psi^2) c - E c) ]
///     [       -c*            0 ] [dE] = [ -(1 - c* c)/2            ]
/// converges quadratically from a guess near a state, on grids of any size: H, which must be split, enters
/// through its products alone. The system is solved by GMRES, preconditioned by the same one with T + (mean
/// of V + 3 g psi^2) - E in place of the rest, bounded away from zero.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

struct StationaryState {
    double energy = 0;            ///< E
    std::vector<Complex> c;       ///< of norm 1
    std::vector<double> history;  ///< energies from the guess on
    double residual = 0;          ///< |(H + g psi^2) c - E c|
    bool isConverged = false;
};

/// From a guess and its mean energy, at t = 0; with an interaction g the guess is real at the nodes.
/// Converged where the energy moves by less than 1e-13 of its size, or of the round-off of products with H;
/// at most 12 steps.
StationaryState refineState(const Hamiltonian& hamiltonian, std::vector<Complex> guess, double g = 0);

}  // namespace extremal
