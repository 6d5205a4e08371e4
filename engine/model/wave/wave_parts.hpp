// SPDX-License-Identifier: GPL-3.0-or-later
/// What a wave function has besides its motion: levels, the sizes of its coefficients, the premise of its
/// exact solution and the error of its mesh.
#pragma once

#include <memory>

#include "engine/model/system.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// Adds CoefficientSizes and OnOtherMesh of model/parts.
void addWaveParts(System& system, const std::shared_ptr<const Hamiltonian>& hamiltonian);
/// Adds what linear equations have besides: PotentialLevels, PremiseCheck and MeshError.
void addLinearWaveParts(System& system, const std::shared_ptr<const Hamiltonian>& hamiltonian);

}  // namespace extremal
