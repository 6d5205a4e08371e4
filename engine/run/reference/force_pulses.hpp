// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for times at which the forces change faster than the motion, before anything is integrated: an
/// error control that never falls on a pulse does not know of it.
///
/// The formula of the forces L_q(t, q, v) is known, so that it can be enclosed over a range of t. The run is
/// halved into leaves on which the change of the impulse is small,
///
///     (sup - inf of each force over the leaf) * length <= 0.02 P   or   length < 1e-9 T,
///
/// P: the largest momentum of the motion. The number of leaves grows with the logarithm of the width of a
/// pulse alone. In t this is an enclosure; the states are samples of a motion.
#pragma once

#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

struct ForcePulses {
    std::vector<double> ends;  ///< of the leaves, ascending, with those of the run; empty: there is no scan
    std::vector<ReferenceInfo::At> pulses;  ///< places with leaves much shorter than most of the run
    bool isEverywhere = false;              ///< driven faster than its motion all the time
    int boxes = 0;
    /// The shortest leaf that contains a part of (a, b).
    double shortestIn(double a, double b) const;
};

/// Of a typed Lagrangian that depends on time; else empty. `motion`: any solution, for its states.
ForcePulses forcePulses(const System& system, const State& initial, double end, const ExactSolution& motion);

}  // namespace extremal
