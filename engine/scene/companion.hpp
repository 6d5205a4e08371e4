/// The companion of a scheme: the same scheme with one degree more, over the same steps. The difference of
/// the two runs is an estimate of the error of the first, which costs no reference.
///
/// - discretizations: degree s + 1, and one node more of the same rule, with the same composition;
/// - baselines with a number of stages: one more;
/// - other symmetric baselines of one step: Yoshida's composition of two orders more;
/// - other baselines of systems with coordinates: Gauss collocation of twice the order;
/// - error-controlled codes: a hundredth of the tolerance.
/// On meshes the error in space remains: schemes of fields have no companion.
#pragma once

#include "engine/scene/resolve.hpp"

namespace extremal {

/// Throws InvalidScene, pointer relative to the scheme, where there is none.
ResolvedScheme companionOf(const ResolvedScheme& scheme, const System& system);

/// By how many rad of the fastest motion at the start a step goes on, where that is too far for the companion
/// to tell the error: both may step over the motion in the same way. 0: it is not. Measured over the presets:
/// beyond 2 rad, and beyond 0.5 rad where a system knows a fast oscillation of itself and spaces contain it,
/// the differences of seven scenes of seven are off by more than a factor of 3 in many rows.
double unresolvedTurn(const ResolvedScheme& scheme, const System& system, const State& initial);

}  // namespace extremal
