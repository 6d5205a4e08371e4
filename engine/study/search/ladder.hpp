// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps, or tolerances, at which a study runs a scheme.
///
///     h_i = (end - start)/n_i,   n_i whole, so that every run ends where the scene does.
///
/// Given as a list, or as ends and a number of points in equal ratios. By default they follow from the scene:
/// from eight times the scheme's own step down in halves to a hundredth of it, coarse ones as long as the run
/// has four steps, fine ones as long as it has at most 200,000. Error-controlled schemes run
/// over tolerances, 1e-3 to 1e-13 in decades, whatever the steps.
/// Schemes whose step follows from their space have that one alone. Where the mesh is refined with the step,
/// so that twice as many steps cost four times as much, by default from eight times the scheme's own step to
/// a quarter of it.
#pragma once

#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// Of a study: a list, or from, to and the number of points; empty: the default of each scheme.
struct LadderSpec {
    std::vector<double> steps = {};
    double from = 0, to = 0;
    int points = 0;
    bool operator==(const LadderSpec&) const = default;
};

/// Whether the step of a scheme follows from its space, so that it has no other.
bool hasStepOfItsSpace(const ResolvedScene& scene, const ResolvedScheme& scheme);

/// From the largest down, each once. Throws InvalidScene (pointers "--steps", "--from", "--points") where the
/// specification makes no ladder.
std::vector<double> ladderOf(const LadderSpec& spec, const ResolvedScene& scene, const ResolvedScheme& scheme,
                             bool isMeshRefined = false);

}  // namespace extremal
