// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions by collocation in time at the nodes of a rule: the curve of degree s through the start
/// satisfies the equation at every node. At the Gauss nodes this is the variational scheme, with a potential
/// that may depend on time, of order 2s and unitary; at nodes that are not symmetric it is neither
/// variational nor unitary.
#pragma once

#include <memory>

#include "engine/core/catalog.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {

/// Only the nodes of the rule count. None may be at the start of the step.
std::unique_ptr<WaveStep> makeCollocationWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                              double shift, const Rule<double>& rule, double tolerance,
                                              int maxIterations);

/// What collocation at the Chebyshev roots does. The step is P(-z)^-1 P(z), z = -i dt H/hbar, where H is
/// constant: unitary, and a function of H, so that norm and energy stay. Where H depends on time the stages
/// have H at different times, which do not commute; then the quadratic invariants alone would keep the norm,
/// b_i a_ij + b_j a_ji = b_i b_j, and of collocation only that at Gauss nodes has it (Hairer, Lubich and
/// Wanner 2006, IV.2.1). With one node it is Gauss.
Claims collocationClaims(int degree);

}  // namespace extremal
