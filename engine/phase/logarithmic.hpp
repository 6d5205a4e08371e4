// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion in a time tau in which it is explicit and equal steps follow the potential: of H = T(p) + V(q)
/// with T = sum_i w_i p_i^2 / 2 and V < c the motions of energy H_0 are those of
///     K(t, q; p_t, p) = log(T(p) + p_t + c) - log(c - V(q)),    p_t = -H_0,
/// on K = 0, where both arguments are equal: t' = 1/(T + p_t + c), q' = w p t', p' = -V'/(c - V).
///
/// K is a sum of a function of (p_t, p) and one of (t, q), so that kicks and drifts in turn are explicit. In
/// the field of one mass, c = 0, their orbits are those of Kepler, and only the time is wrong.
/// Sources: Mikkola and Tanikawa 1999; Preto and Tremaine 1999.
#pragma once

#include "engine/model/parts/energy_formula.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

/// K of a separable H; `formula`: that of H, null where it has none.
PhaseMechanics logarithmicMotion(const PhaseMechanics& H, const EnergyFormula* formula, double c);

}  // namespace extremal
