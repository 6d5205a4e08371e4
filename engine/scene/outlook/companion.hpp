// SPDX-License-Identifier: GPL-3.0-or-later
/// The companion of a scheme: a better run over the same nodes. The difference of the two runs is an estimate
/// of the error of the first, which costs no reference.
///
/// - discretizations: degree s + 1, and one node more of the same rule;
/// - baselines with a number of stages: one more;
/// - other symmetric baselines of order 2 and of one step: Yoshida's composition of order 4;
/// - other baselines of systems with coordinates that are not symmetric: Gauss collocation of twice the
/// order;
/// - all compositions, and symmetric baselines of higher order: the same with half the step. Their error
///   constants are so small that a composition of them, whose parts are longer than the step, would have
///   larger errors than they have themselves. The difference is the error to 2^-order of it;
/// - error-controlled codes: a hundredth of the tolerance.
/// On meshes the error in space remains: schemes of fields have no companion.
///
/// The second companion checks the first: the scheme itself with half the step, or, where that is the first,
/// with a third; of an error-controlled code with a tenth of the tolerance of the first, or, where that is
/// below round-off, with one between its own and that of the first. The bar opens where the two disagree
/// (run/reference/open_bar.hpp).
#pragma once

#include <optional>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// Throws InvalidScene, pointer relative to the scheme, where there is none.
/// Its step is that of its own spec.
ResolvedScheme companionOf(const ResolvedScheme& scheme, const System& system);

/// Its step is half of that of the scheme, or a third; of an error-controlled code its tolerance is another.
/// Empty where time steps are unknowns.
std::optional<ResolvedScheme> secondCompanionOf(const ResolvedScheme& scheme, const ResolvedScheme& first);

/// By how many rad of the fastest motion at the start a step goes on, where that is too far for the companion
/// to tell the error: both may step over the motion in the same way. 0: it is not. Measured over the presets:
/// beyond 2 rad, and beyond 0.5 rad where a system knows a fast oscillation of itself and spaces contain it,
/// the differences of seven scenes of seven are off by more than a factor of 3 in many rows.
double unresolvedTurn(const ResolvedScheme& scheme, const System& system, const State& initial);

}  // namespace extremal
