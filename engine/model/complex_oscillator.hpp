// SPDX-License-Identifier: GPL-3.0-or-later
/// The oscillator with a complex frequency, as a real Lagrangian of two coordinates.
///
/// The equation z'' = -W z with complex z = q_0 + i q_1 and W has the Lagrangian (z'^2 - W z^2)/2, which is
/// analytic in z and z'. Its real part
///
///     L = (q_0'^2 - q_1'^2)/2 - (Re W (q_0^2 - q_1^2) - 2 Im W q_0 q_1)/2
///
/// has the same equations, by those of Cauchy and Riemann; so has the discrete action that a variational
/// scheme makes of it. A step of any linear scheme is therefore that on z' = P, P' = -W z, with P = p_0 - i
/// p_1. The solutions exp(+-lambda t), lambda^2 = -W, grow and decay as the linear test equation y' = lambda
/// y does, which has no Lagrangian.
#pragma once

#include <complex>

#include "engine/model/system.hpp"

namespace extremal {

/// State (q_0, q_1, p_0, p_1).
System complexOscillator(std::complex<double> W);

}  // namespace extremal
