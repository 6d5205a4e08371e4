// SPDX-License-Identifier: GPL-3.0-or-later
/// What systems in typed variables share ("phase-space", "poisson"): their columns, start, errors and
/// picture.
#pragma once

#include <string>
#include <vector>

#include "engine/core/text/number_in.hpp"
#include "engine/model/first_order/first_order.hpp"
#include "engine/model/system.hpp"

namespace extremal::typed {

/// A system with the state x, one entry for each name, and, behind an odd number of names, one that is 0.
/// Its start may be typed in the parameters.
System systemOf(const std::string& id, const std::vector<std::string>& names, const Constants& parameters,
                const FirstOrder& equations);

/// Throws InvalidScene where H or its gradient is not finite at a state.
void checkEnergy(const FirstOrder& equations, const State& at);

/// The key "hamiltonian".
FieldInfo hamiltonianField(const char* example);

/// The key "x" of their initial data.
FieldInfo startField();

}  // namespace extremal::typed
