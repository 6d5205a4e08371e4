// SPDX-License-Identifier: GPL-3.0-or-later
/// The exact motion of a free rigid body: momentum and attitude at any time, from those at the start.
///
/// Axes are renamed so that Pi_3 > 0 never vanishes (the axis of largest moment where L^2 > 2 E I_2, else of
/// smallest):
///     Pi = (A cn u, +-B sn u, C dn u),   u = lambda t + u_0,   lambda^2 = C^2 (1/I_1 - 1/I_3)(1/I_2 -
///     1/I_3), A^2 = I_1 (L^2 - 2 E I_3) / (I_1 - I_3),  B, C alike,   m = (L^2 - 2EI_3)(I_1 - I_2) / ((L^2 -
///     2EI_1)(I_3 - I_2)).
/// The attitude is R = R_0 S_0^T Rz(psi) S, where S is the shortest rotation from Pi / L to e_3, and
///     psi' = (2 E / L + L c / I_3) / (1 + c),  c = Pi_3 / L,
///     psi = 2 E t / L + (1/I_1 - 1/I_3) / lambda [ C^2 u / L + L (Pi(n; u) - u) - C atan(sqrt(1 - n) tan am
///     u) / sqrt(1 - n) ],
/// n = I_3 (I_1 - I_2) / (I_1 (I_3 - I_2)) <= 0, Pi(n; u) the elliptic integral of the third kind (Pi - u is
/// formed by itself). All differences such as L^2 - 2 E I_3 are sums of terms of one sign, and 1 - m has its
/// own formula, so that nothing is lost near the separatrix, with symmetric bodies or thin rods. Permanent
/// rotations (Pi x Omega = 0) turn uniformly. Sources: Jacobi 1849; van Zon and Schofield, J. Comput. Phys.
/// 225 (2007); Celledoni, Fasso, Saefstroem and Zanna, SIAM J. Sci. Comput. 30 (2008), for psi.
#pragma once

#include <array>

#include "engine/model/system.hpp"

namespace extremal {

/// The solution through a state (model/body/body.hpp, SO(3)), or an empty one where the formula is too
/// ill-conditioned: where the momentum creeps so slowly that dividing by lambda costs more than three digits.
ExactSolution freeBodyMotion(const std::array<double, 3>& inertia, const State& initial);

}  // namespace extremal
