// SPDX-License-Identifier: GPL-3.0-or-later
/// The sections of a passport that a tableau has.
#pragma once

#include "engine/passport/document.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {

/// The step in formulas, stage by stage, in the order in which an explicit one takes them.
void addStep(const Tableau& tableau, Document& page);
/// A, b and c to 30 digits, or as fractions.
void addCoefficients(const Tableau& tableau, Document& page);
/// By trees up to order 6, with residuals.
void addOrderConditions(const Tableau& tableau, Document& page);
/// Symplecticity, symmetry and simplifying assumptions of the coefficients.
void addStructure(const Tableau& tableau, Document& page);
/// R(z), and half the trace of the step on the oscillator.
void addStabilityFunction(const Tableau& tableau, Document& page);

}  // namespace extremal
