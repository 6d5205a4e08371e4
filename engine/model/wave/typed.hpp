// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers and functions as users write them inside the keys of a model whose shape no descriptor can hold:
/// potentials and wave packets.
///
/// Every error is an InvalidScene that names the pointer, with a caret below the place in an expression.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/number_in.hpp"
#include "engine/core/value.hpp"

namespace extremal::wave {

using extremal::Constants;

/// A function of place and time: of x, of y too where there is one, and of t where that is allowed.
struct Function {
    std::function<double(double x, double y, double t)> value;
    bool usesTime = false;
};
struct Variables {
    bool hasY = false, hasTime = false;
};
Function functionOf(const std::string& text, const std::string& pointer, const Constants& constants,
                    Variables variables);

/// One parameter of a named potential or packet.
struct Parameter {
    std::string key;
    double fallback = 0;
    bool isRequired = false, isPositive = false;
};
/// The parameters of an object, in their order; keys that are neither parameters nor `others` are errors.
std::vector<double> parametersOf(const Value& object, const std::string& pointer,
                                 const std::vector<Parameter>& parameters,
                                 const std::vector<std::string>& others, const Constants& constants);

}  // namespace extremal::wave
