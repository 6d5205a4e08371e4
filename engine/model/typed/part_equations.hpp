// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of motion for people, with what acts beside a typed Lagrangian written out:
///
///     m x″ = −c x′ + 2 λ x,    x² + y² − l² = 0
///
/// On the left is d/dt ∂L/∂v − ∂L/∂q, on the right are the forces F − ∂D/∂v, the reactions λ ∂g/∂q of
/// constraints and those μ ∂a/∂v of relations of velocities; then come the relations themselves. What cannot
/// be read is left out: it is refused elsewhere, with its place.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::typed {

/// Formulas beside the Lagrangian, by name or by coordinate.
struct PartTexts {
    std::vector<std::pair<std::string, std::string>> constraints, rolling, forces;
    std::string dissipation;
    std::vector<std::string> controls;  ///< names that formulas of forces may use
    bool isEmpty() const {
        return constraints.empty() && rolling.empty() && forces.empty() && dissipation.empty();
    }
};

/// Those of the keys of a typed model, written out from sums and names by index.
PartTexts partTextsOf(const Settings& model);

/// One line per coordinate, and one per relation; empty for formulas that would fill pages.
/// Errors: ExpressionError, of the Lagrangian.
std::vector<std::string> equationLines(const Formula& formula, const PartTexts& parts, TextForm form);

/// The same as an environment of TeX, aligned at the equals signs.
std::string texOfEquations(const Formula& formula, const PartTexts& parts);
/// Lines of TeX as such an environment; empty where there are none.
std::string alignedTex(std::vector<std::string> lines);

}  // namespace extremal::typed
