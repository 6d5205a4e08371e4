// SPDX-License-Identifier: GPL-3.0-or-later
/// Starts given by two positions: q at the start and q_1 a time `at` later, in place of a momentum.
///
/// The exact motion between them gives the start of the scene, p_0 = -D_1 L_d^exact(q_0, q_1, at): errors are
/// measured from it. Every scheme passes through both positions as well, with its own momentum. For a
/// discretization with n = at / step:
///     n = 1: p_0 = -D_1 L_d(q_0, q_1, h);  n > 1: the same of n elements, discrete Euler-Lagrange at the
///     nodes between.
/// Baselines with a fixed step find theirs by shooting; adaptive ones start from the exact momentum.
/// Errors: InvalidScene where no motion is found, or where whole steps do not reach `at`.
#pragma once

#include "engine/core/state.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// q_0 and p_0 of the exact motion; pointers from the root of the scene. Remembers the last answer.
State exactStart(const Scene& scene, const System& system);

/// The start of one scheme with this step: that of the scene unless the scene gives two positions. Pointers
/// are relative to the scheme.
State schemeStart(const ResolvedScene& scene, const ResolvedScheme& scheme, double step);

}  // namespace extremal
