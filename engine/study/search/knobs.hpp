// SPDX-License-Identifier: GPL-3.0-or-later
/// What a search may change besides the step or the tolerance of a scheme.
///
///     --knobs step,degree,cells,modes,harmonics,mesh-nodes,courant,tolerance
///
/// All but the last by default; the step is always searched.
///
/// The tolerance of the solver costs what equations solved to round-off give: momentum maps, symplecticity.
/// So it is searched only if it is asked for.
#pragma once

#include <string>

namespace extremal {

struct SearchKnobs {
    bool isDegree = true;      ///< degree and nodes, of schemes of the scene
    bool isCells = true;       ///< elements in space, of schemes on meshes
    bool isStepFactor = true;  ///< the number that steps follow from, of schemes that have one
    bool isSmaller = true;     ///< functions that a space may leave out, of schemes of the scene
    bool isTolerance = false;  ///< of the solver, of implicit schemes
    bool operator==(const SearchKnobs&) const = default;
};

/// Empty: all. Throws InvalidScene ("--knobs").
SearchKnobs parseKnobs(const std::string& text);
std::string textOf(const SearchKnobs& knobs);

}  // namespace extremal
