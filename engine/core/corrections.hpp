// SPDX-License-Identifier: GPL-3.0-or-later
/// The loop of iterations whose corrections are compared with the largest entry of what they correct: the
/// implicit baselines, and the small systems of constraints and impacts. The steps of the families have
/// NewtonPolicy (solve/newton_policy.hpp), which also says when a Jacobian is renewed.
///
/// It ends where a correction is a unit of the last place; or is within the round-off of the equations and no
/// longer shrinks. Trouble is an Outcome: stopped, notFinite, diverged, and what the correction itself says.
#pragma once

#include <limits>
#include <stop_token>
#include <utility>

#include "engine/core/outcome.hpp"

namespace extremal {

struct CorrectionLimits {
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    int most = 50;  ///< corrections before the iteration is given up
    /// Relative size of a correction that is the last one.
    double last = epsilon;
    /// Below this, a correction that is larger than the part `stall` of the one before is the last one too.
    double roundOff = 1e4 * epsilon;
    double stall = 0.25;
    /// A correction larger than this part of the one before ends the iteration as diverged, after `patience`
    /// corrections; infinity: never.
    double slow = std::numeric_limits<double>::infinity();
    int patience = 3;
};

/// One correction: its size and that of what it corrects, in the same unit.
struct Correction {
    double size = 0, scale = 0;
    bool isSettled = true;                 ///< whether each entry by itself is solved too
    Outcome outcome = Outcome::converged;  ///< what kept it from being made
};

/// correct(iteration, ratio) makes one correction; ratio is the size of the one before over that before it, 0
/// where they are not known. Counts iterations and notes the relative size of the last one.
template <class Correct>
Outcome solveByCorrections(const CorrectionLimits& limits, const std::stop_token& stop, StepReport& report,
                           Correct&& correct) {
    double before = std::numeric_limits<double>::infinity(), ratio = 0;
    for (int iteration = 0; iteration < limits.most; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        const Correction c = correct(std::as_const(iteration), std::as_const(ratio));
        if (c.outcome != Outcome::converged) return c.outcome;
        ++report.cost.iterations;
        report.residual = c.scale > 0 ? c.size / c.scale : c.size;
        if (!(c.size < std::numeric_limits<double>::infinity())) return Outcome::notFinite;
        const bool isSmall = c.size <= limits.last * c.scale ||
                             (c.size < limits.roundOff * c.scale && c.size >= limits.stall * before);
        if (isSmall && c.isSettled) return Outcome::converged;
        if (iteration > limits.patience && c.size > limits.slow * before && !isSmall)
            return Outcome::diverged;
        ratio = c.size / before;
        before = c.size;
    }
    return Outcome::diverged;
}

}  // namespace extremal
