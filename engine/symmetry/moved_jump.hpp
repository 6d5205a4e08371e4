// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a symmetry moves a jump of a typed Lagrangian, which the derivatives of L do not tell.
///
/// L = x_t^2/2 - sign(x - 50) has the derivatives of a free body everywhere but at the jump itself, and is
/// another function after a translation in x. A jump lies where the argument s(t, q, v) of a switch
/// (model/typed/branches.hpp) is on a limit; it stays where it is if
///     s_q.xi + s_v.(A v + c - tau1 v) + s_t tau = 0      there.
#pragma once

#include "engine/symmetry/symmetry.hpp"

namespace extremal {

bool movesJump(const Mechanical& mechanics, const Symmetry& symmetry);

}  // namespace extremal
