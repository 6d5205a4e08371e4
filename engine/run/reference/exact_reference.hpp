// SPDX-License-Identifier: GPL-3.0-or-later
/// How good an exact solution is itself: the error that it is said to have when it serves as a reference.
///
/// The largest of
///     its round-off: a phase that grows by w t is not known better than to the round-off of w t
///     its condition: how far the motion goes when the initial data change by half a unit in their last
///     place,
///         which is what they are known to; near a separatrix or a close encounter this grows without bound
///     its mesh (wave functions): its distance from the exact motion with twice as many modes
///     its boundary (fields): what the solution of the infinite line violates at the ends of the domain
///         (model/field/exact_profile.hpp)
#pragma once

#include <stop_token>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// In the units of the first column of the error. The scene has an exact solution.
double errorOfExact(const ResolvedScene& resolved, const std::stop_token& stop);

}  // namespace extremal
