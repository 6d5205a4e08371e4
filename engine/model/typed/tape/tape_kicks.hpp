// SPDX-License-Identifier: GPL-3.0-or-later
/// Kicks and drifts in turn where the forces are the outputs of a tape: positions are moved in its registers,
/// and momenta are kicked from them, so that nothing is copied between the forces of a step.
#pragma once

#include <span>

#include "engine/model/mechanics.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

/// As Mechanics::kicksAndDrifts, by a tape whose first inputs are the coordinates and whose outputs are as
/// many forces; it reads no other inputs.
void kicksAndDrifts(const Tape& forces, std::span<const KickAndDrift<double>> pairs, const double* perMass,
                    bool isForceKnown, double* q, double* p, double* force);

}  // namespace extremal::typed
