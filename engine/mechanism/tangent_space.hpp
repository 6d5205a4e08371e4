// SPDX-License-Identifier: GPL-3.0-or-later
/// Variations (dq, dp) of a state that the conditions of a mechanism allow:
///     g_q dq = 0,    d(g_q v + g_t) = 0,    d(a v - b) = 0,    L_vv dv = dp - L_vq dq.
/// Where there are no conditions these are all of them.
#pragma once

#include "engine/model/system.hpp"
#include "engine/model/tangent_basis.hpp"

namespace extremal {

/// At states on the constraints; empty where there are no conditions.
TangentBasis tangentBasis(const System& system);

/// How many there are, of any system with coordinates: 2 d - 2 g - r.
int freeVariations(const System& system);

}  // namespace extremal
