// SPDX-License-Identifier: GPL-3.0-or-later
/// The error that a motion of a wave function shares with its schemes (model/parts/mesh_error.hpp): it is
/// exact for the modes of the scene, or computed with them.
///
/// With N modes, and 2N along each side where all eigenstates of those are known (Eigenstates::denseLimit),
///     the largest distance of both motions over the run
/// which is the error with N modes to two digits as soon as that with 2N is small. Else, with potentials that
/// act at the nodes, whether they depend on time or not, the bound
///     |psi_N(0) - psi_2N(0)| + (1/hbar) integral of |(H_2N - H_N) psi_N| dt
/// of motions that keep distances; and else the distance from N/2 modes, which is more than it.
#pragma once

#include <memory>

#include "engine/model/parts/mesh_error.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// That of a computed motion is the bound: eigenstates are not known of a potential that depends on time, or
/// of so many modes. On a periodic domain, as wave functions between walls have no others.
MeshError waveMeshError(std::shared_ptr<const Hamiltonian> hamiltonian);

}  // namespace extremal
