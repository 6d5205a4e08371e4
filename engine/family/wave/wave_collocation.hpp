/// Wave functions by collocation in time at the nodes of a rule: the curve of degree s through the start
/// satisfies the equation at every node. At the Gauss nodes this is the variational scheme, with a potential
/// that may depend on time, of order 2s and unitary; at nodes that are not symmetric it is neither
/// variational nor unitary.
#pragma once

#include <memory>

#include "engine/family/wave/wave_step.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

/// Only the nodes of the rule count. None may be at the start of the step.
std::unique_ptr<WaveStep> makeCollocationWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                              double shift, const Rule<double>& rule, double tolerance,
                                              int maxIterations);

}  // namespace extremal
