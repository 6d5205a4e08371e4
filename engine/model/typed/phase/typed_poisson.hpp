// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of "model" of type "poisson" and what they mean: variables, their bracket {"x,y": formula} for
/// {x, y}, a Hamiltonian, and Casimirs by name, as expressions in the variables and parameters.
///
/// Pairs that are left out commute. Refused are brackets that do not obey Jacobi's identity and Casimirs that
/// do not commute with every variable, found at random places.
///
/// Errors: InvalidScene with pointers below /model; what is wrong inside a formula is shown with a caret
/// under the place.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/first_order/poisson.hpp"

namespace extremal::typed {

/// {x_i, x_j}, i < j, as a formula.
struct BracketText {
    std::size_t i = 0, j = 0;
    std::string text;
    std::string pointer;  ///< where it was typed
};
/// Those that are typed. Throws InvalidScene.
std::vector<BracketText> bracketTextsOf(const Settings& settings);

struct TypedPoisson {
    std::vector<std::string> names;
    PoissonStructure structure;  ///< with a further variable where the names are of odd number
};
/// Throws InvalidScene.
TypedPoisson poissonOf(const Settings& settings);

}  // namespace extremal::typed
