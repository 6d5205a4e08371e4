// SPDX-License-Identifier: GPL-3.0-or-later
/// The error that the exact motion of a wave function shares with its schemes: it is exact for the modes of
/// the scene, not for the equation.
///
/// With N modes, and 2N along each side where all eigenstates of those are known (Eigenstates::denseLimit),
///     the largest distance of both motions over the run
/// which is the error with N modes to two digits as soon as that with 2N is small. Else, with potentials that
/// act at the nodes, the bound
///     |psi_N(0) - psi_2N(0)| + (1/hbar) integral of |(H_2N - H_N) psi_N| dt
/// of motions that keep distances; and else the distance from N/2 modes, which is more than it.
#pragma once

#include <stop_token>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// The system is a wave function with a known exact motion.
double meshErrorOf(const Scene& scene, const System& system, const State& initial,
                   const std::stop_token& stop);

}  // namespace extremal
