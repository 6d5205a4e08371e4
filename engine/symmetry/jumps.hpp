// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a typed Lagrangian jumps, which its derivatives do not tell.
///
/// L = x_t^2/2 - sign(x - 50) has the derivatives of a free body everywhere but at the jump itself, and is
/// another function after a translation in x. A jump lies where the argument s(t, q, v) of a switch
/// (model/typed/branches.hpp) is on a limit; a symmetry leaves it where it is if
///     s_q.xi + s_v.(A v + c - tau1 v) + s_t tau = 0      there.
#pragma once

#include <vector>

#include "engine/symmetry/symmetry.hpp"

namespace extremal {

/// Symmetries of systems with more coordinates are not combined from samples: candidates alone are tried.
inline constexpr std::size_t mostSampledCoordinates = 8;

/// A place on a jump, and the derivatives of s.
struct Jump {
    double t = 0;
    std::vector<double> q, v;
    std::vector<double> gradient;  ///< s_q, then s_v
    double st = 0;

    bool isMovedBy(const Symmetry& symmetry) const;
};

/// Some places on every jump that random states lead to.
std::vector<Jump> jumpsOf(const Mechanical& mechanics);

/// The same of relations s(t, q) of places (constraints; gaps of walls) that a symmetry must not change, at
/// random states: there the symmetry leaves not only s = 0 but every value of s.
std::vector<Jump> relationsOf(const System& system, bool areWallsKept);

}  // namespace extremal
