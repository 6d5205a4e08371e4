// SPDX-License-Identifier: GPL-3.0-or-later
/// Leok's scheme for wave functions, linear in time with the action of each slab integrated by a rule, in
/// three levels:
///     (i hbar/2)(v^{l+1} - v^{l-1}) = dt H (alpha v^{l-1} + (1 - 2 alpha) v^l + alpha v^{l+1}),
///     alpha = sum_i b_i c_i (1 - c_i):  1/6 exact (Milne-Simpson), 0 trapezoidal (leapfrog), 1/4 midpoint.
/// One solve per step, with zeta = 1/(2 alpha) and Y = dt (H - Ec)/hbar:
///     v^{l+1} = -v^{l-1} - k v^l + (zeta + iY)^{-1} zeta (2 v^{l-1} + k v^l),   k = (1 - 2 alpha)/alpha.
/// Roots e^{-i theta}: sin theta = mu (1 - 2 alpha + 2 alpha cos theta), mu = E dt/hbar. Both are on the unit
/// circle while |mu| <= (1 - 4 alpha)^{-1/2}; the second, parasitic one stands at theta = pi - mu/3 + .. for
/// alpha = 1/6. What is kept is not the norm but the bilinear form
///     J = Re<v^{l+1}, v^l> + (2 alpha dt/hbar) Im <v^{l+1}, (H - Ec) v^l>,
/// v without the phase of Ec: a quantity of the step.
///
/// The first step needs v^1. Order 4 (alpha = 1/6) with one step of Gauss degree 2 or an exact one; with the
/// natural start of the action, i hbar v^0/2 as the momentum, (i hbar/2)(v^1 - v^0) = dt H ((1/2 - alpha) v^0
/// + alpha v^1), order 2: the printed "second order" is that of this start. The multiplier lambda of the
/// printed scheme is left out: it is zero on the physical root, and elsewhere moves the phase.
#pragma once

#include <memory>

#include "engine/family/wave/wave_solve.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {

enum class WaveStart { gauss, variational, exact };

struct ThreeLevel {
    double alpha = 1.0 / 6;
    WaveStart start = WaveStart::gauss;
    WaveSolver solver = WaveSolver::banded;
    double tolerance = 1e-14;
    int maxIterations = 600;
};

std::unique_ptr<WaveStep> makeThreeLevelWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                             double shift, const ThreeLevel& form);

/// alpha of the rule that a scene names; "exact" is 1/6.
double threeLevelAlpha(const Settings& quadrature);
/// Largest mu = |E| dt/hbar; infinity for alpha >= 1/4.
double threeLevelLimit(double alpha);

}  // namespace extremal
