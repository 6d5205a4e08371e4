// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene's oscillatory space and its rule mean: the functions of each coordinate, the frequency, the
/// tables of a step, and whether the step is near a resonance.
///
/// Keys of the space: `omega` (a number; "model": what the system says; "estimate": measured on a short
/// resolved run from the start), `degree` and `harmonics` of every coordinate, `fast` {degree, harmonics} of
/// those the system calls fast, and `variables` {name: {degree, harmonics}} of single ones. Rules: a Filon
/// grid, whose cost does not depend on the frequency; a plain rule that resolves the oscillation; or "auto",
/// the cheaper of the two where both are stable: below some three fast periods per step the phases of a grid
/// are no longer independent of its nodes, and large spaces fail on it.
///
/// Functions that read keys throw InvalidScene with pointers relative to the scheme.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/multiscale/basis.hpp"

namespace extremal {

bool isOscillatory(const Settings& space);
bool isFilon(const Settings& quadrature);

/// One basis for each coordinate.
std::vector<OscillatoryBasis> oscillatoryBases(const Settings& space, const System& system);

/// z = step * frequency, for each frequency of the space; the second 0 where there is one.
Phases<double> oscillatoryPhases(const System& system, const Settings& space, double step);
/// A plain rule that resolves a step of phase z: 24 Gauss points per period, and enough for amplitudes of
/// this degree.
Settings resolvingRule(double z, int degree);

/// One table for each coordinate. `omega` must not be "estimate" any more: see withEstimates
/// (family/scheme.hpp).
std::vector<Table<double>> oscillatoryTables(const System& system, const Discretization& discretization,
                                             double step);

/// The default keys of a rule, which follow from the highest degree D and harmonic H: a Filon grid has D + 2
/// nodes and 2 K + 2 phases, K = 2 H + 1; "auto" stays what it is until the step is known.
Settings completeOscillatoryRule(const Settings& space, const Settings& quadrature);
Properties describeOscillatory(const Settings& space, const Settings& quadrature);

/// The frequency of the fastest motion from a state on: of some periods of a resolved run, whose fastest
/// coordinate is fitted by a cubic and (cos wt, sin wt): amplitudes that change would hide a part of w. The
/// linearised frequency where it hardly oscillates. Throws InvalidScene where nothing oscillates.
double estimateFrequency(const System& system, const State& start);

}  // namespace extremal
