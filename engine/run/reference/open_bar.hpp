// SPDX-License-Identifier: GPL-3.0-or-later
/// From when on the difference from a companion is not an estimate of the error any more: it is above 0.05 of
/// the size of the state, of systems with coordinates the rms of |q| over the rows; from the start where
/// steps do not resolve the fastest motion (scene/outlook/companion.hpp), or many of the companion's steps
/// failed. It opens as well where a second companion disagrees: at the first row where the two differences
/// from the scheme are apart by more than half of the largest that either had so far, and by more than
/// round-off explains, or the tolerance of an error-controlled code. Where steps are too long for the order
/// that is claimed, each companion errs in its own way. And it opens at the first row behind a jump of the
/// forces, such as that of |x| at 0: the error of a step over it depends on where in the step it falls, and
/// two companions may agree by accident.
#pragma once

#include <stop_token>
#include <string>

#include "engine/run/comparison.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

/// Fills Summary::opensAt and the caution. `initial`: of the run.
void judgeBar(SchemeResult& result, const System& system, const State& initial);

/// Fills the caution where there is no bar, for the reason given; and opens it from the start where more than
/// 2 % of the companion's steps had events (no root of the energy equation, ...): its own error may then be
/// the larger one.
void judgeCompanion(SchemeResult& result, const Reference& reference, const std::string& reason);

/// Opens it where the second companion disagrees, or the forces jump. `second`: its solution, empty where the
/// scheme has no second companion; `factor`: of its difference, as its own error is a known part of the
/// scheme's.
void judgeAgreement(SchemeResult& result, const System& system, const State& initial,
                    const ExactSolution& second, double factor, const std::stop_token& stop);

}  // namespace extremal
