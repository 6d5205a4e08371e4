// SPDX-License-Identifier: GPL-3.0-or-later
/// A rule of the user's: nodes, and weights or those of the polynomial through the nodes.
///
/// Its degree is the highest for which the shifted Legendre moments sum_i b_i P_k(2 c_i - 1), k = 1..degree,
/// vanish to 1e-13; it is symmetric where nodes and weights are mirror images to 1e-14. Errors are
/// InvalidScene with pointers below /quadrature: nodes outside [0, 1] or not ascending, weights that do not
/// sum to 1.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

/// Keys nodes and weights (may be missing): arrays of numbers or expressions without names. T: double or
/// quadruple precision.
template <class T>
Rule<T> typedRule(const Settings& quadrature);

}  // namespace extremal
