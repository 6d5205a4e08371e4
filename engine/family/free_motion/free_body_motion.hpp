// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of rigid bodies that move freely between knots of the step, where the potential kicks them.
///
/// The curves of the space are free motions between knots c_j = a_1 + .. + a_j of the step, and the rule has
/// its nodes at the knots, with the weights b_j:
///     S = sum_j S_T(g_{j-1}, g_j; a_j h) - h sum_j b_j U(g_j),
/// S_T the action of the free motion from one to the other. Stationarity in the inner g_j is a kick, Pi+ =
/// Pi- + b_j h f(g_j), and so the step is the product of the flows of T and U by a splitting table. As [U,
/// [U, [U, T]]] = 0, Nystrom tables have their order.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal {

/// Of a rigid body with a potential.
std::unique_ptr<Integrator> makeFreeBodyMotion(const System& system, const Splitting& splitting, double step);

}  // namespace extremal
