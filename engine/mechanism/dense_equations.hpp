// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a step with full matrices: any Lagrangian, constraints and forces, of few coordinates.
#pragma once

#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_equations.hpp"

namespace extremal {

std::unique_ptr<MechanismEquations> denseEquations(const Mechanism& mechanism, SharedCurve curve);

}  // namespace extremal
