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

}  // namespace extremal
