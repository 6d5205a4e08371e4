// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic-energy-momentum integrators: the end times of elements are degrees of freedom, and minus the
/// energy is their multiplier.
///
/// Given (t_0, q_0) with multipliers (-E, p_0), stationarity of the discrete action in the end time besides
/// the other degrees of freedom adds one equation for the step h:
///     E_d(h) = -dS/dh = E,        E_d(h) = sum_i b_i [ L_v . v - L ] on the step of length h from (q_0,
///     p_0),
/// so that E_d is the same on every element. E is that of the first step, whose length is given; it differs
/// from H(q_0, p_0) by (r + 1) h^r density, r the order of the discretization and h^(r+1) density its local
/// error of the action. Stationarity in the times equidistributes that error: h |density|^(1/(r+1)), the
/// monitor, is constant but for O(h^2).
///
/// Where the density changes its sign the equation has no root. What then happens is the policy:
///     reset     a step of the first length, and E is what it has: constant in pieces,
///     minimise  the length with the smallest (E_d - E)^2, E stays (Leok 2004, sec. 5; it collapses, as
///               that is the shortest step allowed),
///     keep      a step of the first length, E stays,
///     stop      Outcome::energyUnsolvable.
/// Such steps have the event energyUnsolvable, and count as rejected.
///
/// The root is sought by Newton's method for u = h^r, in which E_d - H is linear to leading order, then on a
/// grid of the window [shrink, grow] times the last step, and never outside [least, most]. -h is always near
/// a root as well, so steps keep their sign.
///
/// Source: Leok 2004, sec. 5, where the energies of consecutive elements have the wrong relative sign; Kane,
/// Marsden, Ortiz 1999.
#pragma once

#include <array>
#include <memory>

#include "engine/action/table.hpp"
#include "engine/core/settings.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

enum class UnsolvablePolicy { reset, minimise, keep, stop };

struct MovingTimeOptions {
    double first = 0;  ///< length of the first step; negative: back in time
    UnsolvablePolicy policy = UnsolvablePolicy::reset;
    double shrink = 0.5, grow = 2;  ///< of a step against the one before
    double least = 0, most = 0;     ///< of all steps
    int order = 2;                  ///< r
};

/// What the keys of the space say: a window and limits that follow from the first step where they are not
/// given. Throws InvalidScene.
MovingTimeOptions movingTimeOptions(const Settings& space, int order, double firstStep);

/// Limits of the step where none are given, as multiples of the first.
inline constexpr double usualLeast = 0.25, usualMost = 30;

/// E_d and E_d' are those of an element with a table; L must not depend on time.
std::unique_ptr<Integrator> makeMovingTime(const Mechanics<double>& mechanics, const Table<double>& table,
                                           const MovingTimeOptions& options, const SolverPolicy& policy);

}  // namespace extremal
