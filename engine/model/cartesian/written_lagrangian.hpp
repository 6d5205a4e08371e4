// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in the plane as a typed Lagrangian.
///
/// Coordinates are x_A, y_A of each point A that moves by itself, and x_B, y_B, phi_B of each body B.
///     L = sum m/2 |r'|^2 + J/2 phi'^2 - m g y - sum k/2 (|r1 - r2| - l)^2
///     rods    |r1 - r2|^2 - l^2 = 0,   pins r1 - r2 = 0 (two conditions, NAME_x and NAME_y),
///     sliders n . (r - r0) = 0,   driven angles phi - f(t) = 0, of a rod dx sin f - dy cos f = 0
///     dampers D = c/2 (d|r1 - r2|/dt)^2,   to the ground c/2 |r'|^2,   of a body c/2 phi'^2
///     motors  the torque on phi, on a rod about its fixed end a force T/l^2 (-dy, dx) at the other end
///     walls   gaps by name; of several points NAME_POINT, of a box NAME_left ...
/// Numbers become parameters named after the element: m_A, J_B, l_ROD, k_SPRING, c_DAMPER, T_MOTOR, g.
#pragma once

#include "engine/model/cartesian/elements.hpp"
#include "engine/model/parts/written_form.hpp"

namespace extremal::cartesian {

WrittenForm writtenLagrangian(const Elements& elements);

}  // namespace extremal::cartesian
