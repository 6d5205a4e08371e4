// SPDX-License-Identifier: GPL-3.0-or-later
/// Solves the augmented action of action/saddle_point.hpp with its multipliers, by Newton on the whole
/// indefinite system.
///
/// Two problems: both ends fixed, or the start and its momentum given (then the row of the last end and the
/// column of the first multiplier fall away). Dense: for a few elements beside a run, and as the route that
/// condensed steps are held against. Trouble is an Outcome.
#pragma once

#include <Eigen/Core>

#include "engine/action/saddle_point.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

struct AssembledElements {
    Outcome outcome = Outcome::diverged;
    Eigen::VectorXd x;            ///< all unknowns in the order of SaddlePoint
    Eigen::MatrixXd multipliers;  ///< d x (N + 1): p_0 ... p_N
    Eigen::VectorXd start, end;   ///< q_0, q_N
};

/// From q_0 to q_N, the first and the last column of `nodes`; the others are a guess, as are straight lines
/// between.
AssembledElements solveBetween(const SaddlePoint& problem, double t0, const Eigen::MatrixXd& nodes);

/// From q_0 with the momentum p_0; the first column of `nodes` is q_0, the others are a guess.
AssembledElements solveFrom(const SaddlePoint& problem, double t0, const Eigen::MatrixXd& nodes,
                            const Eigen::VectorXd& p0);

}  // namespace extremal
