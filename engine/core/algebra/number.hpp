// SPDX-License-Identifier: GPL-3.0-or-later
/// A number of a scene as the user wrote it: a literal, or an expression in the model's parameters with its
/// value.
#pragma once

#include <string>

namespace extremal {

struct Number {
    double value = 0;
    std::string expression;  ///< empty for a literal
    bool operator==(const Number&) const = default;
};

}  // namespace extremal
