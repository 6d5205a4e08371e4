// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps of a scheme for K = g (H + p_t), with equal steps dtau (phase/monitored.hpp), as those of the
/// system itself: the time t is a coordinate of K, and that of the state. The energy H_0 and g at the start
/// are the memory of the run: dtau = first / g(start).
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/phase/monitored.hpp"

namespace extremal {

/// `scheme`: for problem.system, of one step. `first`: the first step, negative where the run goes back.
std::unique_ptr<Integrator> makeMonitored(const MonitoredProblem& problem, std::unique_ptr<Integrator> scheme,
                                          double first);

}  // namespace extremal
