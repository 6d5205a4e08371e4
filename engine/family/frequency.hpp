// SPDX-License-Identifier: GPL-3.0-or-later
/// Frequencies of a linear system M q'' + K q = 0, and of what a system is near a state.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Largest root w of det(K - w^2 M) = 0, to some digits; 0 where nothing oscillates.
double highestFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// All frequencies w > 0 of the linearisation L_vv q'' = L_qq q at a state, to round-off, ascending. Where
/// it is not a sum of oscillators (forces that depend on velocities, a mass matrix that is not positive),
/// where the system has more than 200 coordinates or gives its highest frequency itself: that one alone.
std::vector<double> linearFrequencies(const System& system, const State& state);

}  // namespace extremal
