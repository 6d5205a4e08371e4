// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of bodies that move on Kepler arcs between knots of the step, where they kick each other.
///
/// The curves of the space are the motions of L_0 = sum_i (m'_i |r_i'|^2 / 2 + K_i / |r_i|) between knots c_j
/// of the step, in Jacobi coordinates (jacobi_motion.hpp), and the rule of what is left of the Lagrangian,
/// -U, has its nodes at the knots:
///     S = sum_j S_0(r_{j-1}, r_j; a_j h) - h sum_j b_j U(r_j).
/// Stationarity in the inner r_j is a kick, p+ = p- - b_j h dU(r_j): the splittings that are made for planets
/// (Wisdom and Holman 1991), here for every table.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/parts/held_bodies.hpp"
#include "engine/model/system.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal {

/// Of a separable system whose coordinates are those of the bodies.
std::unique_ptr<Integrator> makeKeplerMotion(const System& system, const HeldBodies& bodies,
                                             const Splitting& splitting, double step);

}  // namespace extremal
