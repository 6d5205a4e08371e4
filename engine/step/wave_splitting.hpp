// SPDX-License-Identifier: GPL-3.0-or-later
/// Split-step methods for wave functions: a splitting table with A the kinetic part, a phase for each wave
/// number, and B the potential, a phase at each node. Unitary for every step; explicit; V may depend on time,
/// which moves with A.
///
/// A kick costs two transforms. If a step ends with a kick and the next begins with one, the values at the
/// nodes are reused, and the second kick costs one.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal {

/// Of a wave function whose H is split.
std::unique_ptr<Integrator> makeWaveSplitting(const System& system, double step, const Splitting& splitting);

}  // namespace extremal
