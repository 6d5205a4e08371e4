// SPDX-License-Identifier: GPL-3.0-or-later
/// Hamilton's vector field with forces and reactions in it, for methods that see a system through its flow:
///     qdot = v,    pdot = L_q + F + g_q^T lambda,
/// lambda from the constraints differentiated twice (index 1). Nothing keeps such a method on g = 0: it
/// drifts off, by the order of the method.
#pragma once

#include "engine/model/mechanisms.hpp"

namespace extremal {

/// The parts that are in that flow.
inline Takes drivenProblems() { return firstOrderProblems().with<Constraint, Force, Rolling>(); }

/// The mechanics of a system with that flow; those of the system itself where it has a Lagrangian alone. Its
/// other calls are of the Lagrangian, and it is not separable.
Mechanics<double> drivenMechanics(const System& system);
/// Whether they are such: the Hessian of the Lagrangian is then not all of the Jacobian of the flow.
bool isDriven(const Mechanics<double>& mechanics);

}  // namespace extremal
