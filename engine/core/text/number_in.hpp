// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers as users write them inside keys whose shape no descriptor can hold: literals, and expressions in
/// the constants of a model.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

/// Names that expressions may use besides pi, with their values.
using Constants = std::vector<std::pair<std::string, double>>;

/// A finite number. Throws InvalidScene with the pointer, and a caret below the place in an expression.
double numberIn(const Value& value, const std::string& pointer, const Constants& constants);

/// A list of so many of them; `remedy`: for a list that is not.
std::vector<double> numbersIn(const Value& value, const std::string& pointer, int count,
                              const Constants& constants, const std::string& remedy);

/// "it may use m, k and pi", for errors in expressions.
std::string namesIn(const Constants& constants, std::vector<std::string> others);

}  // namespace extremal
