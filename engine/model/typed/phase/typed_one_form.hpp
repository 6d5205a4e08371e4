// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of "model" of type "phase-space" and what they mean: variables, a one-form {variable: formula}
/// and a Hamiltonian, as expressions in the variables and parameters.
///
/// Errors: InvalidScene with pointers below /model; what is wrong inside a formula is shown with a caret
/// under the place.
#pragma once

#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/first_order/one_form.hpp"

namespace extremal::typed {

struct TypedOneForm {
    std::vector<std::string> names;
    OneForm form;
    std::vector<int> cyclic;  ///< variables that neither the form nor H has: their theta is conserved
};
/// Throws InvalidScene.
TypedOneForm oneFormOf(const Settings& settings);

}  // namespace extremal::typed
