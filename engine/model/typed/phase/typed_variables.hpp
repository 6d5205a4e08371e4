// SPDX-License-Identifier: GPL-3.0-or-later
/// What models in typed variables share, "phase-space" and "poisson": the names of their variables, their
/// parameters and the Hamiltonian.
///
/// Errors: InvalidScene with pointers below /model.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::typed {

/// The names under "variables", at most 64, each with one meaning.
std::vector<std::string> variablesOf(const Settings& settings);
std::vector<std::pair<std::string, double>> parametersOf(const Settings& settings);
/// The key "hamiltonian" as one formula, of an object the sum of its terms.
std::string energyTextOf(const Settings& settings);
/// "hamiltonian": a formula, or the sum of an object of formulas.
TypedFunction typedEnergyOf(const Settings& settings, const std::vector<std::string>& names,
                            const std::vector<std::pair<std::string, double>>& parameters);

/// A typed function with whole Hessians, entry (k, l) at k n + l of n variables; the last two may be null.
void evaluateWhole(const TypedFunction& f, const double* x, double* value, double* gradient, double* hessian);

}  // namespace extremal::typed
