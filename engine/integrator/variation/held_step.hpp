// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a scheme in which numbers of the formulas are part of the state, and stay as they are:
///
///     x = (q, u, p, P),    (q_1, p_1) = step(q_0, p_0; u),    u_1 = u_0,    P_1 = P_0 + sum_i w_i L_u(i),
///
/// at the nodes and with the weights of the scheme. It is the step of the system of d + u coordinates in
/// which those of u have no velocity (held_coordinates.hpp), for the work of d coordinates. Its tangent
/// map is known transposed: with the solution of the transposed equations of the scheme the derivatives by u
/// are sums over the nodes (integrator/variation/transposed_step.hpp).
#pragma once

#include <memory>
#include <optional>

#include "engine/integrator/integrator.hpp"
#include "engine/integrator/variation/held_coordinates.hpp"

namespace extremal {

/// `scheme`: on the system of `held`. `integral`: the one entry of P that changes; the others stay as they
/// are, and no number may be differentiated that depends on them. Null where the scheme does not tell its
/// nodes.
std::unique_ptr<Integrator> heldStep(std::unique_ptr<Integrator> scheme, HeldCoordinates held,
                                     std::optional<std::size_t> integral);

}  // namespace extremal
