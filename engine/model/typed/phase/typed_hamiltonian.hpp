// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of "model" of type "hamiltonian" and what they mean: H as an expression in the coordinates x, the
/// momenta p_x, parameters, controls and t.
///
/// H is differentiated as any formula, with the names (x, .., p_x, ..) as the coordinates of it: symbols are
///     q_i: i,   p_i: d + i,   t: 4d,   parameter k: 6d + 1 + k   (typed/formula.hpp of 2d coordinates).
/// Errors: InvalidScene with pointers below /model; what is wrong inside the formula is shown with a caret
/// under the place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

/// The formula of H, of the coordinates and then the momenta. Throws InvalidScene.
Formula phaseFormulaOf(const Settings& settings);
/// The coordinates alone, for pictures and names.
Formula coordinatesOf(const Formula& phaseFormula);

struct TypedHamiltonian {
    PhaseMechanics mechanics;
    std::vector<int> cyclic;  ///< coordinates that are not in H: their momenta are conserved
};
/// Throws InvalidScene.
TypedHamiltonian hamiltonianOf(const Formula& phaseFormula);

/// What is wrong with H at a state; empty if nothing is.
std::optional<std::string> hamiltonianFaultAt(const PhaseMechanics& mechanics, double t, const double* q,
                                              const double* p);

}  // namespace extremal::typed
